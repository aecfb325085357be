#include "check/polygons/join_polygons.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace plumbline::check {

namespace {

struct Edge {
  std::size_t from, to;
  bool operator==(const Edge&) const = default;
};

// Vertex numbers in the order of the one closed line that uses every edge; empty: the edges form no such line.
// Precondition: at each vertex as many edges end as begin.
std::vector<std::size_t> closed_line(std::span<const Edge> edges) {
  std::vector<std::size_t> line;
  if (edges.empty()) return line;
  std::size_t at = edges.front().from;
  for (std::size_t n = 0; n < edges.size(); ++n) {
    line.push_back(at);
    const auto next = std::ranges::find(edges, at, &Edge::from);
    if (next == edges.end() || std::ranges::count(edges, at, &Edge::from) != 1) return {};
    at = next->to;
    if (at == line.front() && n + 1 < edges.size()) return {};
  }
  return line;
}

// The edges, each cut where a vertex lies on it: of an edge that two parts share, a cut at a small angle may leave more
// in one part than in the other.
std::vector<Edge> split_at(std::span<const ClipVertex<double>> vertices, std::span<const Edge> edges,
                           const Corners& corners, double tolerance) {
  std::vector<Edge> out;
  for (const Edge& edge : edges) {
    std::vector<std::pair<double, std::size_t>> on;  // share of the way, vertex
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      if (i == edge.from || i == edge.to) continue;
      const auto [share, distance] = nearest_on_line(vertices[i], vertices[edge.from], vertices[edge.to], corners);
      if (share > 0 && share < 1 && distance <= tolerance) on.emplace_back(share, i);
    }
    std::ranges::sort(on);
    std::size_t from = edge.from;
    for (const auto& [share, i] : on) out.push_back({std::exchange(from, i), i});
    out.push_back({from, edge.to});
  }
  return out;
}

std::vector<Edge> without_pairs(std::span<const Edge> edges) {
  std::vector<Edge> out;
  for (const Edge& edge : edges) {
    const auto opposite = std::ranges::find(out, Edge{edge.to, edge.from});
    if (opposite == out.end()) {
      out.push_back(edge);
    } else {
      out.erase(opposite);
    }
  }
  return out;
}

}  // namespace

std::vector<ClipVertex<double>> join_polygons(std::span<const std::span<const ClipVertex<double>>> parts,
                                              const Corners& corners, double tolerance) {
  std::vector<ClipVertex<double>> vertices;  // each once
  const auto number_of = [&](const ClipVertex<double>& v) {
    const auto same =
        std::ranges::find_if(vertices, [&](const auto& w) { return largest_difference(v, w, corners) <= tolerance; });
    if (same == vertices.end()) return vertices.push_back(v), vertices.size() - 1;
    return static_cast<std::size_t>(same - vertices.begin());
  };
  std::vector<Edge> edges;
  for (const auto part : parts) {
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Edge edge{number_of(part[i]), number_of(part[(i + 1) % part.size()])};
      if (edge.from != edge.to) edges.push_back(edge);
    }
  }
  const std::vector<Edge> left = without_pairs(split_at(vertices, edges, corners, tolerance));
  std::vector<ClipVertex<double>> out;
  const std::vector<std::size_t> line = closed_line(left);
  for (std::size_t i = 0; i < line.size(); ++i) {
    const ClipVertex<double>&before = vertices[line[(i + line.size() - 1) % line.size()]], &v = vertices[line[i]],
          &after = vertices[line[(i + 1) % line.size()]];
    bool between = false;
    for (std::size_t p = 0; p < corners.planes && v.cut; ++p) {
      const auto is_on = [&](const ClipVertex<double>& w) { return on_plane(w, p, tolerance * corners.scale); };
      between |= is_on(before) && is_on(v) && is_on(after);
    }
    if (!between) out.push_back(v);
  }
  return out;
}

}  // namespace plumbline::check

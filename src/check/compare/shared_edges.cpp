#include "check/compare/shared_edges.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace plumbline::check {

namespace {

auto ends(const auto& edge) { return std::tuple(edge.low.x, edge.low.y, edge.high.x, edge.high.y); }

// Sign of the cross product of `along` and `to`: each product is rounded, and fma() gives what rounding took from it.
int side_of(glm::dvec2 along, glm::dvec2 to) {
  const double first = along.x * to.y, second = along.y * to.x;
  const double off =
      first != second ? first - second : std::fma(along.x, to.y, -first) - std::fma(along.y, to.x, -second);
  return off > 0 ? 1 : off < 0 ? -1 : 0;
}

}  // namespace

std::array<glm::dvec2, 3> window_corners(const WindowTriangle<double>& t, bool snapped) {
  std::array<glm::dvec2, 3> out;
  for (std::size_t i = 0; i < 3; ++i)
    out[i] = snapped ? 0.5 + glm::dvec2(t.v[i].snapped) / double{kSubpixel} : glm::dvec2(t.v[i].p_win);
  return out;
}

std::optional<SharedEdges::Edge> SharedEdges::edge_of(std::uint32_t t, std::size_t side) const {
  if (triangles_[t].corners != 3) return std::nullopt;
  const std::array<glm::dvec2, 3> corners = window_corners(triangles_[t], snapped_);
  glm::dvec2 low = corners[side], high = corners[(side + 1) % 3];
  if (std::tuple(high.x, high.y) < std::tuple(low.x, low.y)) std::swap(low, high);
  const int third = side_of(high - low, corners[(side + 2) % 3] - low);
  if (third == 0) return std::nullopt;  // without area
  return Edge{low, high, t, third > 0};
}

SharedEdges::SharedEdges(std::span<const WindowTriangle<double>> triangles, bool snapped)
    : triangles_(triangles), snapped_(snapped) {
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t side = 0; side < 3; ++side) {
      if (const std::optional<Edge> edge = edge_of(t, side)) edges_.push_back(*edge);
    }
  }
  std::ranges::sort(edges_, {}, [](const Edge& e) { return ends(e); });
}

std::optional<std::uint32_t> SharedEdges::beyond(std::uint32_t t, glm::dvec2 p_win) const {
  for (std::size_t side = 0; side < 3; ++side) {
    const std::optional<Edge> edge = edge_of(t, side);
    if (!edge) continue;
    const glm::dvec2 along = edge->high - edge->low, to = p_win - edge->low;
    const double way = glm::dot(along, to);
    if (side_of(along, to) != 0 || !(way > 0) || !(way < glm::dot(along, along))) continue;
    const auto alike = std::ranges::equal_range(edges_, ends(*edge), {}, [](const Edge& e) { return ends(e); });
    if (alike.size() != 2 || alike[0].is_left == alike[1].is_left) return std::nullopt;
    return alike[0].triangle == t ? alike[1].triangle : alike[0].triangle;
  }
  return std::nullopt;
}

}  // namespace plumbline::check

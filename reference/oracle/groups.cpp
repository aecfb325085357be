// Groups: possible hits that together certainly cover a pixel.
//
// Take the triangles that a renderer may draw near a pixel, each oriented counter-clockwise in double, and sum their
// outlines: where two of them share an edge and lie on opposite sides of it, the edge cancels. If no edge that passes
// within delta of the pixel is left, the sum's winding number is the same everywhere within delta of the pixel, and
// does not change while the vertices move by less than delta (equal positions are transformed and snapped alike). A
// member near the pixel makes the winding number at least 1, before and after snapping. A triangle that snapping turns
// over counts -1; so the pixel is covered by a triangle that is not turned over and that no renderer culls; on a shared
// edge, the tie rule gives the pixel to one of the two triangles.
// Thin members are thus allowed. A silhouette does not cancel: both its triangles lie on the same side.
#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/oracle/pixel_hit.h"
#include "reference/oracle/pixel_site.h"

namespace plumbline::math {

namespace {

struct NearEdge {
  std::uint32_t from, to;  // Corner::point of the ends, from < to
  int winding;             // +1 if the member's outline runs from -> to, else -1
  std::size_t member;      // index into hits
};

std::vector<NearEdge> near_edges(const Projected& projected, std::span<PixelHit> hits, glm::dvec3 d, double delta) {
  std::vector<NearEdge> edges;
  for (std::size_t m = 0; m < hits.size(); ++m) {
    if (hits[m].hit.certain || !hits[m].may_join_group) continue;
    const Triangle& t = projected.triangles[hits[m].hit.primitive];
    for (std::size_t i = 0; i < 3; ++i) {
      const Corner &j = projected.corners[t.corner[(i + 1) % 3]], &k = projected.corners[t.corner[(i + 2) % 3]];
      if (edge_distance(t.n[i], j.v, k.v, d).pixels > delta) continue;
      const int winding = (t.sign > 0) == (j.point < k.point) ? 1 : -1;
      edges.push_back({std::min(j.point, k.point), std::max(j.point, k.point), winding, m});
    }
  }
  std::sort(edges.begin(), edges.end(),
            [](const NearEdge& a, const NearEdge& b) { return a.from != b.from ? a.from < b.from : a.to < b.to; });
  return edges;
}

std::size_t root(std::vector<std::size_t>& parent, std::size_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

int form_groups(const Projected& projected, std::span<PixelHit> hits, int px, int py) {
  double delta = 0;
  std::size_t candidates = 0;
  for (const PixelHit& h : hits) {
    if (h.hit.certain || !h.may_join_group) continue;
    delta = std::max(delta, h.delta);
    ++candidates;
  }
  if (candidates < 2) return 0;
  const std::vector<NearEdge> edges = near_edges(projected, hits, projected.ray(px, py), delta);

  // Members that share an edge are connected; an edge that does not cancel excludes all members connected with it.
  std::vector<std::size_t> parent(hits.size());
  for (std::size_t i = 0; i < hits.size(); ++i) parent[i] = i;
  std::vector<bool> open(hits.size(), false);
  for (std::size_t first = 0, last; first < edges.size(); first = last) {
    int winding = 0;
    for (last = first;
         last < edges.size() && edges[last].from == edges[first].from && edges[last].to == edges[first].to; ++last) {
      winding += edges[last].winding;
      parent[root(parent, edges[last].member)] = root(parent, edges[first].member);
    }
    if (winding != 0) open[edges[first].member] = true;
  }
  std::vector<bool> spoiled(hits.size(), false);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (open[i]) spoiled[root(parent, i)] = true;
  }
  int groups = 0;
  std::vector<int> number(hits.size(), -1);
  for (const NearEdge& edge : edges) {
    const std::size_t r = root(parent, edge.member);
    if (spoiled[r]) continue;
    if (number[r] < 0) number[r] = groups++;
    hits[edge.member].hit.group = number[r];
  }
  return groups;
}

}  // namespace plumbline::math

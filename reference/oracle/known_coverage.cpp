// Coverage that declared conventions decide.
//
// Declared grid and tie rule (settles_ties()): coverage is open only where a corner may snap to several grid points. It
// may where a position at which the rounding changes (nearest: the middle between two grid points; down, up: a grid
// point) is within corner_displacement() of the corner in double (down, up: plus kOfFixedPoint). Coverage is known
// where all combinations of the corners' grid points agree; the tie rule settles edge functions that are 0. All edges
// own their samples, or none, in renderers that test e >= 0 or e > 0 in the arithmetic they declare: in float, e of a
// slanted edge may be rounded to either side of 0.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "reference/arithmetic/project.h"
#include "reference/oracle/pixel_hit.h"
#include "reference/oracle/pixel_site.h"

namespace plumbline::math {

namespace {

using C = Conventions;

bool covers(const std::array<glm::dvec2, 3>& corners, double sign, glm::dvec2 sample, C::TieRule rule) {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = sign * (corners[(i + 1) % 3] - corners[i]), from = sample - corners[i];
    const glm::dvec2 inward(-along.y, along.x);
    const double e = glm::dot(inward, from);
    if (e < 0 || (e == 0 && !owns_ties(rule, inward))) return false;
  }
  return true;
}

// Whether an edge of the triangle that is neither level, upright nor diagonal passes through the sample.
bool is_on_slanted_edge(const std::array<glm::dvec2, 3>& corners, double sign, glm::dvec2 sample) {
  const auto passes = [&](std::size_t i) {
    const glm::dvec2 along = corners[(i + 1) % 3] - corners[i], from = sample - corners[i];
    const bool is_slanted = along.x != 0 && along.y != 0 && std::abs(along.x) != std::abs(along.y);
    return is_slanted && along.x * from.y == along.y * from.x;
  };
  return covers(corners, sign, sample, C::TieRule::inclusive) && (passes(0) || passes(1) || passes(2));
}

// Whether the arithmetic of edges decides ties.
bool rounds_ties(const C& c) {
  const bool is_by_sign = c.tie_rule == C::TieRule::inclusive || c.tie_rule == C::TieRule::exclusive;
  return is_by_sign && c.depth_arithmetic != C::DepthArithmetic::in_double;
}

// Grid points of a triangle's corner. Those of a copy on the grid are not snapped again: down or up, the rounding of
// v / w would move them by a step.
GridPoints points_of(const Projected& scene, const Triangle& t, std::size_t i) {
  if (!t.on_grid) return grid_points(scene, scene.corners[t.corner[i]]);
  const Corner& copy = scene.corners[scene.on_grid[*t.on_grid].corner[i]];
  const glm::dvec2 at = glm::dvec2(copy.v) / copy.v.z + scene.middle();
  return {{glm::round(std::ldexp(1.0, scene.conventions.subpixel_bits) * at)}, 1};
}

}  // namespace

// Edge functions are exact in double: products of grid coordinates of 1/1024 pixel or coarser (settles_ties()).
std::optional<bool> known_coverage(const Projected& scene, const Triangle& t, int px, int py) {
  const C& c = scene.conventions;
  const bool is_thin = t.thin && !t.on_grid;
  if (t.flat || t.cut || is_thin || !t.facing_kept || !settles_ties(c)) return std::nullopt;
  const double steps = std::ldexp(1.0, c.subpixel_bits);
  const glm::dvec2 sample = steps * (glm::dvec2(scene.ray(px, py)) + scene.middle());
  std::array<GridPoints, 3> points;
  for (std::size_t i = 0; i < 3; ++i) {
    points[i] = points_of(scene, t, i);
    if (points[i].count == 0) return std::nullopt;
  }
  std::optional<bool> known;
  for (std::size_t n = 0; n < points[0].count * points[1].count * points[2].count; ++n) {
    const std::size_t i = n % points[0].count, k = n / points[0].count % points[1].count,
                      l = n / points[0].count / points[1].count;
    const std::array corners = {points[0].at[i], points[1].at[k], points[2].at[l]};
    if (rounds_ties(c) && is_on_slanted_edge(corners, t.sign, sample)) return std::nullopt;
    const bool covered = covers(corners, t.sign, sample, c.tie_rule);
    if (known && *known != covered) return std::nullopt;
    known = covered;
  }
  return known;
}

void settle_coverage(C::TieRule tie_rule, std::vector<PixelHit>& hits) {
  // An exclusive rule leaves a shared edge to neither triangle: no group certainly covers the pixel.
  for (const PixelHit& h : hits) {
    const int group = h.hit.group;
    if (group < 0 || (tie_rule != C::TieRule::exclusive && h.covers != true)) continue;
    for (PixelHit& other : hits) other.hit.group = other.hit.group == group ? -1 : other.hit.group;
  }
  std::erase_if(hits, [](const PixelHit& h) { return h.covers == false; });
  for (PixelHit& h : hits) {
    h.hit.certain = h.hit.certain || h.covers == true;
  }
}

}  // namespace plumbline::math

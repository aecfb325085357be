// Coverage that declared conventions decide.
//
// For a renderer that declares its grid and its tie rule (settles_ties()), coverage is open only where float arithmetic
// decides to which grid point a corner is snapped. Every such renderer snaps a corner to the same grid point where the
// corner's position in double is farther from the middle between two grid points than float arithmetic may displace it
// (corner_displacement()). Where this holds for all three corners of a triangle, the sample's edge functions are known,
// and the tie rule settles those that are 0.
#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/arithmetic/project.h"
#include "reference/oracle/pixel_hit.h"

namespace plumbline::math {

namespace {

using C = Conventions;

/// The grid point to which the corner is snapped, from the window's lower left corner [steps of the grid]; NaN where it
/// is not certain.
glm::dvec2 place_of(const Projected& scene, const Corner& corner, double steps) {
  const glm::dvec2 half(0.5 * scene.width, 0.5 * scene.height), off = steps * corner_displacement(scene, corner);
  const glm::dvec2 at = steps * (glm::dvec2(corner.v) / corner.v.z + scene.sample + half), place = glm::round(at);
  const glm::dvec2 left = 0.5 - glm::abs(at - place);  // distance to the middle between two grid points
  if (left.x > off.x && left.y > off.y) return place;
  return glm::dvec2(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

bool owns_ties(C::TieRule rule, glm::dvec2 inward) {
  using enum C::TieRule;
  if (rule == inclusive || rule == exclusive) return rule == inclusive;
  const bool left = rule == left_bottom || rule == left_top, bottom = rule == left_bottom || rule == right_bottom;
  return inward.x != 0 ? (inward.x > 0) == left : (inward.y > 0) == bottom;
}

// Edge functions are exact in double: products of grid coordinates of 1/1024 pixel or coarser (settles_ties()).
std::optional<bool> known_coverage(const Projected& scene, const Triangle& t, int px, int py) {
  const C& c = scene.conventions;
  if (t.flat || t.cut || t.thin || !t.facing_kept || !settles_ties(c)) return std::nullopt;
  const double steps = std::ldexp(1.0, c.subpixel_bits);
  const glm::dvec2 sample = steps * (glm::dvec2(px, py) + 0.5 + scene.sample);
  std::array<glm::dvec2, 3> place;
  for (std::size_t i = 0; i < 3; ++i) {
    place[i] = place_of(scene, scene.corners[t.corner[i]], steps);
    if (std::isnan(place[i].x)) return std::nullopt;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = t.sign * (place[(i + 1) % 3] - place[i]), from = sample - place[i];
    const glm::dvec2 inward(-along.y, along.x);
    const double e = glm::dot(inward, from);
    if (e < 0 || (e == 0 && !owns_ties(c.tie_rule, inward))) return false;
  }
  return true;
}

void settle_coverage(C::TieRule tie_rule, std::vector<PixelHit>& hits) {
  // By an exclusive rule a shared edge is in neither triangle: no group certainly covers the pixel.
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

// Coverage that declared conventions decide.
//
// Declared grid and tie rule (settles_ties()): coverage is open only where a corner may snap to several grid points. It
// may where a position at which the rounding changes (nearest: the middle between two grid points; down, up: a grid
// point) is within corner_displacement() of the corner in double (down, up: plus kOfFixedPoint). Coverage is known
// where all combinations of the corners' grid points agree; the tie rule settles edge functions that are 0. Rules
// inclusive and exclusive are signs of e. Where float computes e, a sample on an edge is open: e may be rounded to
// either side of 0. Differences of coordinates are exact in float on level and on upright edges, whose products are 0.
//
// Edges whose x is added up in fixed point (edge_bits): a sample within Triangle::stepped of one, in x, is open. Level
// edges have no x.
//
// Positions that are floats (settles_ties_of_floats()): coverage is known between corners that no arithmetic rounds.
// Any rule goes by the sign of e there.
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

// Whether float decides who owns a sample on an edge of this direction.
bool rounds_ties(const C& c, glm::dvec2 along) {
  using enum C::DepthArithmetic;
  const bool is_by_sign =
      c.tie_rule == C::TieRule::inclusive || c.tie_rule == C::TieRule::exclusive || c.subpixel_bits == C::kFloat;
  if (!is_by_sign || c.depth_arithmetic == in_double) return false;
  const bool by_differences = c.depth_arithmetic == in_float || c.depth_arithmetic == in_float_stepped;
  return !by_differences || (along.x != 0 && along.y != 0);
}

// nullopt: float decides, or steps in fixed point, which may move an edge by `moved` in x [as the corners].
std::optional<bool> covers(const std::array<glm::dvec2, 3>& corners, double sign, glm::dvec2 sample, double moved,
                           const C& c) {
  std::optional<bool> out = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = sign * (corners[(i + 1) % 3] - corners[i]), from = sample - corners[i];
    const glm::dvec2 inward(-along.y, along.x);
    const double e = glm::dot(inward, from);
    const bool is_open = (e == 0 && rounds_ties(c, along)) || std::abs(e) < std::abs(along.y) * moved;
    if (!is_open && (e < 0 || (e == 0 && !owns_ties(c.tie_rule, inward)))) return false;
    if (is_open) out = std::nullopt;
  }
  return out;
}

double steps_of(const C& c) { return c.subpixel_bits == C::kFloat ? 1 : std::ldexp(1.0, c.subpixel_bits); }

// Places of a triangle's corner [steps of the grid, or pixels]; none: unknown. Those of a copy on the grid are not
// snapped again: down or up, the rounding of v / w would move them by a step.
GridPoints points_of(const Projected& scene, const Triangle& t, std::size_t i) {
  const Corner& corner = scene.corners[t.corner[i]];
  if (scene.conventions.subpixel_bits == C::kFloat)
    return corner.is_exact ? GridPoints{{scene.place(corner)}, 1} : GridPoints{};
  if (!t.on_grid) return grid_points(scene, corner);
  const Corner& copy = scene.corners[scene.on_grid[*t.on_grid].corner[i]];
  return {{glm::round(steps_of(scene.conventions) * scene.place(copy))}, 1};
}

}  // namespace

// Edge functions are exact in double: products of grid coordinates of 1/1024 pixel or coarser (settles_ties()), or of
// differences of floats of one exponent range (Corner::is_exact).
std::optional<bool> known_coverage(const Projected& scene, const Triangle& t, int px, int py) {
  const C& c = scene.conventions;
  const bool is_thin = t.thin && !t.on_grid;
  if (t.flat || t.cut || is_thin || !t.facing_kept || !(settles_ties(c) || settles_ties_of_floats(c)))
    return std::nullopt;
  const double steps = steps_of(c);
  const double moved = c.edge_bits == C::kFloat ? 0 : steps * t.stepped.x;
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
    const auto covered = covers({points[0].at[i], points[1].at[k], points[2].at[l]}, t.sign, sample, moved, c);
    if (!covered || (known && *known != *covered)) return std::nullopt;
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

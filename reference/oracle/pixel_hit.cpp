#include "reference/oracle/pixel_hit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "reference/arithmetic/error_in_float.h"
#include "reference/arithmetic/widths.h"
#include "reference/oracle/pixel_site.h"

namespace plumbline::math {

namespace {

/// A plane's z_view at a pixel, and its interval.
struct ViewDepth {
  PixelDepth plane;
  double lo, hi;
};

/// Sets the depth interval in the window. `rounding`: what its ends move beyond those of z_view [window z].
void set_window_depth(const Triangle& t, bool clamps, const ViewDepth& view, double rounding, PixelHit& out) {
  const auto& [plane, lo, hi] = view;
  const double scale = range_scale(t);
  const auto [low, high] = clamps ? std::minmax({double{t.range.near}, double{t.range.far}}) : std::pair(0.0, 1.0);
  out.win.z = to_window(t, plane.z);
  if (clamps) out.win.z = std::clamp(out.win.z, low, high);
  out.win.half = scale * plane.half + rounding;
  out.win.slope = (double{t.range.far} - double{t.range.near}) * plane.slope;
  if (!std::isfinite(rounding)) {
    out.hit.z_lo = low;
    out.hit.z_hi = high;
    return;
  }
  const auto [nearest, farthest] = std::minmax({to_window(t, lo), to_window(t, hi)});
  out.hit.z_lo = std::clamp(nearest - rounding, low, high);
  out.hit.z_hi = std::clamp(farthest + rounding, low, high);
}

/// Error of z_view due to the error of the corners' depths, at a point whose z_view is `z`.
double corner_error_at(const PixelSite& site, double z, bool clamps) {
  const double from_middle = std::abs(2 * z - 1), z_ndc = clamps ? from_middle : std::min(from_middle, 1.0);
  return (site.clip_error.z + z_ndc * site.clip_error.w) / (2 * site.w) + kFloatRounding;
}

/// True if the near or the far plane certainly clips the triangle at the pixel. The clipped polygon is displaced by at
/// most `delta` [pixels], whatever plane its depths go through.
bool is_cut_off(const PixelSite& site, double delta) {
  if (site.t.flat || site.scene.depth_clamp) return false;
  const double z = 0.5 + glm::dot(site.t.z_plane, site.d);
  const double most = glm::length(glm::dvec2(site.t.z_plane)) * delta + corner_error_at(site, z, false);
  return z < -most || z > 1 + most;
}

/// True if the sample is within `delta` [pixels] of a diagonal, or a border, of the polygon that a cut leaves.
bool is_at_diagonal(const PixelSite& site, double delta) {
  const auto is_near = [&](const std::vector<glm::dvec2>& corners) {
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t k = i + 1; k < corners.size(); ++k) {
        const std::array segment{corners[i], corners[k], corners[k]};
        if (distance_to_triangle(glm::dvec2(site.d), segment) <= delta) return true;
      }
    }
    return false;
  };
  return is_near(site.t.outline) || is_near(site.t.guarded.outline);
}

/// True if the sample is within `delta` [pixels] of a side of the frame whose samples the tie rule may take from a
/// triangle that the side cuts. Sides are whole pixels: rounding to the nearest puts cut corners back onto them.
bool is_at_side(const PixelSite& site, double delta) {
  const Projected& scene = site.scene;
  const Conventions& c = scene.conventions;
  const bool is_on_grid = c.subpixel_rounding == Conventions::Rounding::nearest;
  const double off = is_on_grid ? std::max(delta - site.t.snap, 0.0) : delta;
  const glm::dvec2 from_middle = glm::dvec2(site.d) + scene.to_frame,
                   half = 0.5 * glm::dvec2(scene.width, scene.height);
  const auto takes = [&](double from_side, const glm::dvec2& inward) {
    return from_side <= off && !(is_on_grid && settles_ties(c) && owns_ties(c.tie_rule, inward));
  };
  return takes(half.x + from_middle.x, {1, 0}) || takes(half.x - from_middle.x, {-1, 0}) ||
         takes(half.y + from_middle.y, {0, 1}) || takes(half.y - from_middle.y, {0, -1});
}

/// True if a cut may make an edge within `delta` [pixels] of the sample that the tie rule takes from the triangle.
/// `at_diagonal`: is_at_diagonal(), whose samples an exclusive rule takes. An inclusive rule takes none where the grid
/// puts cut corners back onto the side; floats may leave them beside it.
bool is_at_cut(const PixelSite& site, bool at_diagonal, double delta) {
  const Conventions& c = site.scene.conventions;
  const Conventions::TieRule rule = c.tie_rule;
  const bool is_put_back =
      c.subpixel_bits != Conventions::kFloat && c.subpixel_rounding == Conventions::Rounding::nearest;
  if (!site.t.cut || (rule == Conventions::TieRule::inclusive && is_put_back)) return false;
  return (rule == Conventions::TieRule::exclusive && at_diagonal) || is_at_side(site, delta);
}

/// Sets the depth interval: the plane's z at the pixel, plus or minus its change over a displacement of h + delta_E
/// (delta_E where depth_corners is as_they_are), plus the corners' depth error. `is_inside`: every legal renderer
/// covers the pixel with the triangle's inside.
void set_depth(const PixelSite& site, bool is_inside, PixelHit& out) {
  const Projected& scene = site.scene;
  const Triangle& t = site.t;
  const bool clamps = scene.depth_clamp;
  const double weight = site.snap_weight(is_inside);
  PixelDepth& view = out.view;
  if (t.flat || !std::isfinite(weight)) {
    view.z = t.ahead ? std::clamp(0.5 * (t.z_min + t.z_max), 0.0, 1.0) : 0.5;
    out.win = {to_window(t, view.z), kInfinity, glm::dvec2(0)};
    view.half = kInfinity;
    out.hit.z_lo = 0;
    out.hit.z_hi = 1;
    out.hit.certain = false;
    return;
  }
  view.z = 0.5 + glm::dot(t.z_plane, site.d);
  view.slope = glm::dvec2(t.z_plane);
  const double corner_error = corner_error_at(site, view.z, clamps);
  const double of_plane = glm::dot(glm::abs(view.slope), weight * site.moved) + weight * corner_error;
  view.half = of_plane + glm::dot(glm::abs(view.slope), glm::dvec2(t.step));
  // Cuts by the near or far plane are snapped, whatever the plane of the depths goes through.
  const bool not_cut = clamps || (view.z - view.half > 0 && view.z + view.half < 1);
  const bool by_grid = scene.conventions.depth_corners != Conventions::DepthCorners::as_they_are;
  const double half = by_grid || site.may_turn_over(out.hit.certain && not_cut) ? view.half : of_plane;
  double lo = view.z - half, hi = view.z + half;
  out.may_join_group = out.may_join_group || (t.facing_kept && not_cut);
  // Inside, every plane comes to a convex combination of the corners' depths; outside it may overshoot them.
  if (is_inside && t.ahead) {
    lo = std::max(lo, t.z_min - corner_error);
    hi = std::min(hi, t.z_max + corner_error);
  }
  out.hit.certain = out.hit.certain && not_cut;
  // Two further roundings, unless the depth range is [0,1], whose rounding is counted already.
  const double in_range = t.range == DepthRange{} ? 0 : 2 * weight * kFloatRounding,
               in_float = error_in_float(scene, t, site.d, site.pieces);
  set_window_depth(t, clamps, {{view.z, half, view.slope}, lo, hi}, in_range + t.offset.half + in_float, out);
}

/// Whether the primitive covers the pixel: by the declared grid and tie rule, or because the triangle's outline on the
/// grid passes farther from the sample than float may displace the outline; nullopt: open.
std::optional<bool> coverage_of(const Projected& scene, const Triangle& t, const PixelSite& covering) {
  const std::optional<bool> known = known_coverage(scene, t, covering.pixel.x, covering.pixel.y);
  if (known || !t.on_grid || !t.facing_kept) return known;
  if (!covering.in_reach) return false;
  if (covering.border <= std::min(covering.t.reach, covering.t.growth * glm::length(covering.moved)))
    return std::nullopt;
  return covering.inside;
}

}  // namespace

std::optional<PixelHit> pixel_hit(const Scene& scene, const Projected& projected, std::uint32_t primitive, int px,
                                  int py, Colors colors) {
  const Triangle& t = projected.triangles[primitive];
  if (!t.drawn) return std::nullopt;
  const std::optional<Scissor>& scissor = scene.draws[t.draw].scissor;
  if (scissor && !scissor->holds(px, py)) return std::nullopt;
  const PixelSite site(projected, t, px, py);
  if (!site.in_reach) return std::nullopt;
  PixelHit out;
  // Rounding may let a triangle seen edge on cover a pixel by its part nearest to the eye.
  out.delta = t.flat ? t.reach : std::min(t.reach, t.snap + t.growth * glm::length(site.moved));
  if (!site.inside && !t.loose && site.border > out.delta) return std::nullopt;
  if (is_cut_off(site, out.delta)) return std::nullopt;
  out.hit.primitive = primitive;
  out.hit.depth_func = scene.draws[t.draw].depth_func;
  out.hit.depth_mask = scene.draws[t.draw].merge.depth_mask;
  const Conventions::TieRule rule = projected.conventions.tie_rule;
  const bool is_of_pieces = rule == Conventions::TieRule::inclusive || rule == Conventions::TieRule::exclusive;
  out.at_diagonal = t.cut && is_of_pieces && is_at_diagonal(site, out.delta);
  const bool at_cut = is_at_cut(site, out.at_diagonal, out.delta);
  const bool is_within = site.inside && site.border > out.delta && !t.thin;
  out.hit.certain = is_within && !at_cut;
  out.at_cut = is_within && at_cut;
  // Two triangles whose shared edge a side plane cuts may round the new corner, down or up, to different grid points.
  const bool apart = t.cut && projected.conventions.subpixel_rounding != Conventions::Rounding::nearest;
  out.may_join_group = t.facing_kept && !t.flat && !t.cut;
  std::optional<PixelSite> copy;
  if (t.on_grid) copy.emplace(projected, projected.covering(primitive), px, py);
  const PixelSite& covering = copy ? *copy : site;
  if (!out.hit.certain) out.covers = coverage_of(projected, t, covering);
  const bool is_by_grid =
      copy && covering.in_reach && projected.conventions.depth_corners == Conventions::DepthCorners::snapped;
  set_depth(is_by_grid ? covering : site, out.hit.certain || (is_by_grid && out.covers == true), out);
  out.covered_inside = out.hit.certain;
  out.may_join_group = out.may_join_group && !apart && !at_cut;
  const PixelDepth& view = out.view;
  if (!scene.depth_clamp && std::isfinite(view.half) && (view.z + view.half < 0 || view.z - view.half > 1))
    return std::nullopt;
  out.colored = colors == Colors::now || scene.draws[t.draw].alpha_test.has_value();
  if (out.colored) set_color(scene, covering, out);
  set_tests(scene.draws[t.draw], t, scene.frame, projected.conventions, out);
  out.inside = out.covers.value_or(site.by_ties && site.inside && t.facing_kept) &&
               (scene.depth_clamp || (view.z >= 0 && view.z <= 1));
  return out;
}

}  // namespace plumbline::math

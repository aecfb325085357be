#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "capture/float_depth.h"
#include "check/bounds/bounds.h"
#include "check/bounds/mean_bounds.h"
#include "check/bounds/shade_bounds.h"
#include "check/bounds/texture_bounds.h"
#include "check/bounds/units.h"
#include "check/compare/compare_records.h"
#include "check/compare/shared_edges.h"
#include "reference/arithmetic/matrices.h"
#include "scene/draw_index.h"

namespace plumbline::check {

namespace {

// `open(fragment)`: whether it is legal that the fragment is extra or missing. A triangle has a pixel once.
Measurement covered_except(const Records<double>& candidate, const Records<double>& reference, auto open) {
  Meter meter("fragments");
  const Covered* before = nullptr;  // the candidate's last fragment
  each_covered(candidate.covered, reference.covered, [&](const Covered& c, bool has, bool should) {
    const bool is_again = has && before != nullptr && draw_order(*before) == draw_order(c);
    if (has) before = &c;
    if (has != should && !is_again && open(c)) {
      meter.ambiguous();
    } else if (has != should) {
      const char* field = is_again ? "twice" : has ? "extra" : "lacking";
      meter.value(1, 0, {c.x, c.y, static_cast<std::int64_t>(c.triangle), field}, has, should);
    }
    meter.item();
  });
  return meter.done();
}

// each(), for records of which the candidate has one per fragment.
template <class Visit>
Measurement each_fragment(const char* what, const std::string& unit, const Records<double>& candidate, std::size_t own,
                          std::size_t reference, Visit visit) {
  if (own == reference && own != candidate.covered.size()) {
    return mismatch(unit, fmt::format("{} {} of {} fragments", own, what, candidate.covered.size()), own);
  }
  return each(what, unit, own, reference, visit);
}

}  // namespace

Measurement compare_covered(const Records<double>& candidate, const Records<double>& reference) {
  return covered_except(candidate, reference, [](const Covered&) { return false; });
}

FragmentSums fragment_sums(std::span<const Covered> fragments, std::span<const WindowTriangle<double>> triangles,
                           int width, int height) {
  FragmentSums out{{width, height}, {width, height}};
  for (const Covered& c : fragments) {
    ++out.count(c.x, c.y);
    out.id_sum(c.x, c.y) += id_weight(triangles[c.triangle].primitive);
  }
  return out;
}

bool are_sums_of(const Records<double>& records, const Planes& planes) {
  if (planes.count.empty()) return false;
  const FragmentSums sums =
      fragment_sums(records.covered, records.triangles, planes.count.width(), planes.count.height());
  return sums.count.values() == planes.count.values() &&
         (planes.id_sum.empty() || sums.id_sum.values() == planes.id_sum.values());
}

bool has_corner_between_places(const WindowTriangle<double>& t, const Conventions& conventions, SnappedBy snapped_by) {
  if (snapped_by == SnappedBy::renderer) return false;
  const bool is_to_nearest = conventions.subpixel_rounding == Conventions::Rounding::nearest;
  const double a_pixel = std::exp2(conventions.subpixel_bits);  // [steps]
  const auto is_between = [&](int axis, double p_win) {
    const double middle = in_steps(conventions, axis, p_win) - 0.5;
    if (is_to_nearest) return std::abs(middle - std::nearbyint(middle)) <= 4 * u * std::max(std::abs(middle), a_pixel);
    return on_grid(conventions, axis, p_win - kOfFixedPoint) != on_grid(conventions, axis, p_win + kOfFixedPoint);
  };
  return std::ranges::any_of(t.v, [&](const auto& v) { return is_between(0, v.p_win.x) || is_between(1, v.p_win.y); });
}

namespace {

// edge_displacement() of a triangle's edges in a frame of that size [pixels].
double of_steps(const WindowTriangle<double>& t, const Conventions& conventions, glm::dvec2 frame) {
  WindowBox box{glm::dvec2(t.v[0].p_win)};
  for (const WindowVertex<double>& v : t.v) box.add(glm::dvec2(v.p_win));
  return glm::length(edge_displacement(conventions, box, frame));
}

// Error of an edge function in float [pixels]: 8 u of the largest coordinates.
double of_float_edges(const WindowTriangle<double>& t) {
  double most = 0;
  for (const WindowVertex<double>& v : t.v) most = std::max(most, std::abs(v.p_win.x) + std::abs(v.p_win.y));
  return 8 * u * most;
}

// Displacement of a triangle's edges in the candidate [pixels]: by steps, and by the grid, which moves a corner by up
// to half a step in x and in y (rounded down or up: a whole step). Without a grid, edge functions are of float.
double moved(const WindowTriangle<double>& t, const Conventions& conventions, glm::dvec2 frame) {
  const int bits = conventions.subpixel_bits;
  if (bits == Conventions::kFloat) return of_float_edges(t) + of_steps(t, conventions, frame);
  const bool to_nearest = conventions.subpixel_rounding == Conventions::Rounding::nearest;
  return std::numbers::sqrt2 / 2 * std::exp2(to_nearest ? -bits : 1 - bits) + of_steps(t, conventions, frame);
}

// Legality of a sample's membership in the two triangles that share its edge, by a tie rule.
bool is_owned(bool in_one, bool in_other, Conventions::TieRule rule) {
  if (in_one != in_other) return true;
  return rule == (in_one ? Conventions::TieRule::inclusive : Conventions::TieRule::exclusive);
}

// Number of a triangle's edges that pass p within `most` [pixels].
std::size_t edges_near(const std::array<glm::dvec2, 3>& corners, glm::dvec2 p, double most) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = corners[(i + 1) % 3] - corners[i], to = p - corners[i];
    const double length = glm::length(along), beside = std::abs(along.x * to.y - along.y * to.x) / length,
                 before = glm::dot(along, to) / length;
    out += beside <= most && before >= -most && before <= length + most;
  }
  return out;
}

// How a candidate covers pixels: by conventions, with its own snapped corners or those that follow from them; its
// samples' position [pixels from the pixel's corner of smallest coordinates], and its frame's size [pixels].
struct Covering {
  const Conventions& conventions;
  SnappedBy snapped_by;
  glm::dvec2 sample, frame;
};

// Fragments compared. At samples on edges they are ambiguous where open(triangle), unless two triangles share the edge
// and is_owned() is false.
template <class Open>
Measurement covered_except_edges_of(const Records<double>& candidate, const Records<double>& reference,
                                    const Covering& by, Open open) {
  constexpr double kOfExact = std::numbers::sqrt2 / 2 / kSubpixel;  // [pixels] as far as exact moves a corner
  const Conventions& conventions = by.conventions;
  const glm::dvec2 sample = by.sample, frame = by.frame, places = conventions.sample * double{kSubpixel};
  const bool by_one_grid =
      conventions.subpixel_bits >= 0 && conventions.subpixel_bits <= 8 && places == glm::round(places);
  const bool is_of_float = conventions.depth_arithmetic != Conventions::DepthArithmetic::in_double;
  std::optional<SharedEdges> shared;  // once there is a fragment to ask about
  const auto is_covered = [&](Covered c, std::uint32_t triangle) {
    c.triangle = triangle;
    return std::ranges::binary_search(candidate.covered, draw_order(c), {},
                                      [](const Covered& o) { return draw_order(o); });
  };
  // Number of the triangle's edges within reach of p: their displacement by the candidate and, by_both, by exact. On a
  // grid that window.snapped holds, both sides have a corner at one position.
  const auto near = [&](std::uint32_t triangle, glm::dvec2 p, bool by_both) {
    const WindowTriangle<double>& t = candidate.triangles[triangle];
    if (by_one_grid && !has_corner_between_places(t, conventions, by.snapped_by))
      return edges_near(window_corners(t, true), p,
                        of_steps(t, conventions, frame) + (is_of_float ? of_float_edges(t) : 0));
    return edges_near(window_corners(t, false), p, moved(t, conventions, frame) + (by_both ? kOfExact : 0));
  };
  const auto on_an_edge = [&](const Covered& c) {
    const glm::dvec2 p = glm::dvec2(c.x, c.y) + sample;
    const WindowTriangle<double>& triangle = candidate.triangles[c.triangle];
    if (triangle.corners != 3 || !open(triangle) || near(c.triangle, p, true) == 0) return false;
    if (!shared) shared.emplace(candidate.triangles, by_one_grid);
    const std::optional<std::uint32_t> other = shared->beyond(c.triangle, p);
    if (!other || near(c.triangle, p, false) != 1 || near(*other, p, false) != 1) return true;
    return is_owned(is_covered(c, c.triangle), is_covered(c, *other), conventions.tie_rule);
  };
  return covered_except(candidate, reference, on_an_edge);
}

}  // namespace

Measurement compare_covered_except_edges(const Records<double>& candidate, const Records<double>& reference,
                                         const Conventions& conventions, glm::dvec2 sample, glm::dvec2 frame,
                                         SnappedBy snapped_by) {
  return covered_except_edges_of(candidate, reference, {conventions, snapped_by, sample, frame},
                                 [](const auto&) { return true; });
}

Measurement compare_covered_by_rule(const Records<double>& candidate, const Records<double>& reference,
                                    const Conventions& conventions, SnappedBy snapped_by, glm::dvec2 frame) {
  return covered_except_edges_of(
      candidate, reference, {conventions, SnappedBy::conventions, glm::dvec2(0.5), frame},
      [&](const WindowTriangle<double>& t) { return has_corner_between_places(t, conventions, snapped_by); });
}

Measurement compare_open_covered(const Capture& candidate, const Records<double>& reference, const Legal& legal) {
  const auto open = [&](const Covered& c) { return is_open(legal, candidate.planes, c.x, c.y); };
  Measurement illegal = covered_except(candidate.records, reference, open);
  return illegal.differing > 0 ? illegal : compare_covered(candidate.records, reference);
}

namespace {

// Window z where 1/w is 0, for a candidate that interpolates 1/w for depths (depth_error()).
class ZOfZero {
 public:
  ZOfZero(const Scene& scene, const Conventions& conventions) : draws_(scene) {
    if (conventions.depth_of != Conventions::DepthOf::inv_w || scene.draws.empty()) return;
    const glm::dmat4 projection = math::double_matrices(scene, scene.draws.front()).projection;
    z_view_ = math::z_view_of_zero(projection, conventions.clip_depth);
  }
  std::optional<double> in_draw_of(std::uint32_t primitive) const {
    const Draw* draw = z_view_ ? draws_.draw(primitive) : nullptr;
    if (draw == nullptr) return std::nullopt;
    return std::lerp(double{draw->depth_range.near}, double{draw->depth_range.far}, *z_view_);
  }

 private:
  DrawIndex draws_;
  std::optional<double> z_view_;
};

}  // namespace

Measurement compare_depth(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                          double factor, const Conventions& conventions, double from_origin) {
  const double middle = middle_of(conventions.depth_rounding);
  const OffsetErrors offsets(scene, conventions);
  const ZOfZero z_of_zero(scene, conventions);
  const glm::dvec2 frame(scene.frame.width, scene.frame.height);
  // Error of a foreign depth in float [window z]: by the declared arithmetic; else, in z32f, by planes from the
  // window's origin.
  const auto float_error = [&](const WindowTriangle<double>& t, const Covered& c) {
    const bool is_declared = conventions.depth_arithmetic != Conventions::DepthArithmetic::in_double;
    if (from_origin == 0) return 0.0;
    const WindowCorners corners = {t.v[0].p_win, t.v[1].p_win, t.v[2].p_win};
    const std::optional<double> of_zero = z_of_zero.in_draw_of(t.primitive);
    const double of_inv_w = error_of_inv_w(corners, of_zero);
    if (!is_declared && scene.frame.depth != DepthFormat::z32f) return of_inv_w;
    const double by_plane = from_origin * u * (bounds_from_origin(t, c.x, c.y).depth + offsets.of(t));
    if (!is_declared || t.corners < 3) return by_plane + of_inv_w;
    return std::max(by_plane + u,
                    depth_error(conventions.depth_arithmetic, corners, {c.x + 0.5, c.y + 0.5}, frame, of_zero));
  };
  return each_fragment(
      "depths", "step", candidate, candidate.depth.size(), reference.depth.size(), [&](Meter& meter, std::size_t i) {
        const double a = candidate.depth[i], b = reference.depth[i];
        const Covered& c = candidate.covered[i];
        const double step = depth_step(scene.frame.depth, b);
        double apart = difference(a + middle * step, b) / step;
        const bool needed = !(apart <= factor) && c.triangle < candidate.triangles.size();
        // No plane goes through corners on one line, whose samples an inclusive rule takes.
        if (needed && from_origin > 0 && std::isnan(b) && twice_area(candidate.triangles[c.triangle], kSnapped) == 0)
          return meter.ambiguous();
        if (needed && from_origin > 0) {  // a foreign candidate's
          const WindowTriangle<double>& t = candidate.triangles[c.triangle];
          const auto [low, high] = std::minmax({b, b + offsets.by_length(t), b + offsets.by_grid(t)});
          apart = distance_outside(a + middle * step, low, high) / step;
        }
        const double rounding = needed ? depth_rounding(candidate.triangles[c.triangle]) / step : 0;
        const double allowance = needed ? float_error(candidate.triangles[c.triangle], c) / step : 0;
        const Place place{c.x, c.y, c.triangle, "z"};
        if (!std::isfinite(rounding + allowance)) return add_open_value(meter, a, place, b);
        meter.value(apart, factor + rounding, place, a, b, allowance);
      });
}

namespace {

// Error of a colour by the arithmetic that the conventions declare.
double declared_error(const Conventions& conventions, const WindowTriangle<double>& t, const Covered& c,
                      glm::dvec2 frame) {
  if (conventions.depth_arithmetic == Conventions::DepthArithmetic::in_double || t.corners < 3) return 0;
  const WindowCorners corners = {t.v[0].p_win, t.v[1].p_win, t.v[2].p_win};
  const Vec3<double> inv_w(t.v[0].inv_w, t.v[1].inv_w, t.v[2].inv_w);
  const double here = std::abs(glm::dot(barycentrics(t, c.x + 0.5, c.y + 0.5).value, inv_w)),
               nearest = std::max({std::abs(inv_w.x), std::abs(inv_w.y), std::abs(inv_w.z)});
  double most = 0;
  for (const auto& corner : t.v) {
    for (int k = 0; k < 4; ++k) most = std::max(most, std::abs(corner.color[k]));
  }
  const double shares = shares_error(conventions.depth_arithmetic, corners, {c.x + 0.5, c.y + 0.5}, frame);
  return attribute_error(shares * nearest / here, most);
}

}  // namespace

Measurement compare_attributes(const Records<double>& candidate, const Records<double>& reference, double factor,
                               double from_origin, const Conventions& conventions, glm::dvec2 frame) {
  return each_fragment(
      "attributes", "u", candidate, candidate.attributes.size(), reference.attributes.size(),
      [&](Meter& meter, std::size_t i) {
        const Covered& c = candidate.covered[i];
        if (c.triangle >= candidate.triangles.size()) {
          meter.value(kInfinite, 0, {c.x, c.y, c.triangle, "triangle"}, 0, 0);
          return;
        }
        const Vec4<double> bound = bounds_of_mean(candidate.triangles[c.triangle], c.x, c.y);
        const WindowTriangle<double>& triangle = candidate.triangles[c.triangle];
        const Vec4<double> allowance =
            from_origin > 0 ? bounds_from_origin(triangle, c.x, c.y).color_error(from_origin) : Vec4<double>(0);
        const double declared = from_origin > 0 ? declared_error(conventions, triangle, c, frame) : 0;
        // Extrapolated to the horizon, or in an arithmetic that loses all shares: any colour.
        if (!std::isfinite(bound.x + bound.y + bound.z + bound.w + allowance.x + declared)) {
          for (int k = 0; k < 4; ++k)
            add_open_value(meter, candidate.attributes[i].color[k], {c.x, c.y, c.triangle, "color"}, 0);
          return;
        }
        add(meter, candidate.attributes[i].color, reference.attributes[i].color, u * bound + kGradualUnderflow, factor,
            {c.x, c.y, c.triangle, "color"}, allowance + declared);
      });
}

namespace {

// True if shaded colours may lie outside [0, 1]: texels of a float format do.
bool may_exceed_one(const Scene& scene, const Draw& draw) {
  return draw.texture && largest_texel(scene.textures.at(draw.texture->texture)) > 1;
}

// The nearer to `value`, per channel, of `wanted` and `wanted` clamped to [0, 1].
Vec4<double> clamped_or_not(const Vec4<double>& value, const Vec4<double>& wanted) {
  Vec4<double> out = wanted;
  for (int k = 0; k < 4; ++k) {
    const double clamped = std::clamp(wanted[k], 0.0, 1.0);
    if (std::abs(value[k] - clamped) < std::abs(value[k] - wanted[k])) out[k] = clamped;
  }
  return out;
}

}  // namespace

Measurement compare_shaded(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, double copies) {
  const DrawIndex draws(scene);
  // A frame of codes holds nothing beyond [0, 1]: a foreign renderer may clamp its colours before.
  const bool may_clamp = copies > 0 && scene.frame.color != ColorFormat::rgba32f;
  const double unseen = may_clamp ? u / (2 * color_scale(scene.frame.color)) : 0;
  return each_fragment(
      "colours", "u", candidate, candidate.shaded.size(), reference.shaded.size(), [&](Meter& meter, std::size_t i) {
        const Covered& c = candidate.covered[i];
        const Vec4<double>&a = candidate.shaded[i].color, &made = reference.shaded[i].color;
        const Vec4<double> b = may_clamp ? clamped_or_not(a, made) : made;
        const Place place{c.x, c.y, c.triangle, "color"};
        if (c.triangle >= candidate.triangles.size()) return meter.value(kInfinite, 0, place, 0, 0);
        const Draw* draw = draws.draw(candidate.triangles[c.triangle].primitive);
        if (draw == nullptr || is_plain(scene, *draw))
          return add(meter, a, b, Vec4<double>(u), 0, place, copies * u * glm::abs(b) + unseen);
        const Vec4<double> bound = shade_error(scene, *draw, shade_inputs_of(candidate, i), {}, {1});
        for (int k = 0; k < 4; ++k) {
          if (!std::isfinite(bound[k])) {  // a light may come or go
            meter.ambiguous();
            const bool is_legal = std::isfinite(a[k]) && (may_exceed_one(scene, *draw) || (a[k] >= 0 && a[k] <= 1));
            meter.value(is_legal ? 0 : kInfinite, 0, place, a[k], b[k]);
          } else if (bound[k] == 0) {
            meter.value(difference(a[k], b[k]) / u, 0, place, a[k], b[k], copies * std::abs(b[k]) + unseen / u);
          } else {
            meter.value(difference(a[k], b[k]) / bound[k], factor, place, a[k], b[k], unseen / bound[k]);
          }
        }
      });
}

Measurement compare_carried(Varying varying, const Records<double>& candidate, const Records<double>& reference) {
  const auto &a = candidate.varyings[varying].vertices, &b = reference.varyings[varying].vertices;
  return each("varyings", "u", a.size(), b.size(), [&](Meter& meter, std::size_t i) {
    add(meter, a[i], b[i], Vec4<double>(u), 0, {-1, -1, static_cast<std::int64_t>(i), name_of(varying).data()});
  });
}

Measurement compare_drawn(const Records<double>& candidate, const Records<double>& reference) {
  if (candidate.drawn.empty()) return Meter("pixels").done();
  return each_fragment("fragments drawn", "pixels", candidate, candidate.drawn.size(), reference.drawn.size(),
                       [&](Meter& meter, std::size_t i) {
                         const Covered& c = candidate.covered[i];
                         const bool a = candidate.drawn[i].drawn, b = reference.drawn[i].drawn;
                         meter.value(a == b ? 0 : 1, 0, {c.x, c.y, c.triangle, "drawn"}, a, b);
                       });
}

}  // namespace plumbline::check

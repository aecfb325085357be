#include "reference/oracle/pixel_site.h"

#include <algorithm>
#include <cmath>

#include "capture/float_depth.h"
#include "reference/arithmetic/error_in_float.h"
#include "reference/arithmetic/widths.h"

namespace plumbline::math {

namespace {

constexpr Conventions::Interpolation kAffine = Conventions::Interpolation::affine;

/// Largest difference between an attribute with perspective and one without, over the attribute's range, where a
/// renderer may cut the triangle into pieces. A piece's corners have attributes a_i, whose range is within that of the
/// triangle's corners, and w_i in [w_lo, w_hi]. A point has b_i without perspective, and with it c_i = (b_i / w_i) / m,
/// m = sum b_j / w_j >= 1 / w_hi. Half the sum of |b_i - c_i| is the sum of b_i (1 - 1 / (w_i m)) where that is
/// positive: at most 1 - w_lo / w_hi.
double error_of_cuts(const Projected& scene, const Triangle& t, Conventions::Interpolation how) {
  if (how != kAffine || !t.cut) return 0;
  const auto w = [&](std::size_t i) { return scene.corners[t.corner[i]].v.z; };
  const auto [lo, hi] = std::minmax({w(0), w(1), w(2)});
  return 1 - lo / hi;
}

}  // namespace

bool owns_ties(Conventions::TieRule rule, glm::dvec2 inward) {
  using enum Conventions::TieRule;
  if (rule == inclusive || rule == exclusive) return rule == inclusive;
  const bool left = rule == left_bottom || rule == left_top, bottom = rule == left_bottom || rule == right_bottom;
  return inward.x != 0 ? (inward.x > 0) == left : (inward.y > 0) == bottom;
}

EdgeDistance edge_distance(const glm::dvec3& n, const glm::dvec3& v_j, const glm::dvec3& v_k, glm::dvec3 d) {
  const double slope2 = n.x * n.x + n.y * n.y, n2 = glm::dot(n, n);
  if (slope2 > 0 && n2 > 0) {
    const double e = glm::dot(n, d);
    const glm::dvec3 foot(d.x - e / slope2 * n.x, d.y - e / slope2 * n.y, 1);
    // foot = a v_j + b v_k, and 1/w = a + b there
    const double a = glm::dot(glm::cross(foot, v_k), n) / n2, b = glm::dot(glm::cross(v_j, foot), n) / n2;
    if (a >= 0 && b >= 0) return {std::abs(e) / std::sqrt(slope2), foot, 1 / (a + b)};
  }
  EdgeDistance nearest{kInfinity, d, 1};
  for (const glm::dvec3& v : {v_j, v_k}) {
    if (!(v.z > 0)) continue;
    const glm::dvec3 p = v / v.z;
    const double distance = std::hypot(p.x - d.x, p.y - d.y);
    if (distance < nearest.pixels) nearest = {distance, p, v.z};
  }
  return nearest;
}

PixelSite::PixelSite(const Projected& projected, const Triangle& triangle, int px, int py)
    : scene(projected), t(triangle), pixel(px, py), d(projected.ray(px, py)) {
  place();
  w = std::clamp(w, t.w_min, t.w_max);
  in_reach = inside || t.loose || border <= t.reach;
  if (!in_reach) return;
  clip_error = math::clip_error(scene, t, nearest);
  moved = float_displacement(scene, clip_error, nearest, w) + t.stepped;
  find_pieces();
}

void PixelSite::place() {
  inside = by_ties = !t.flat;
  border = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const double e = t.sign * glm::dot(t.n[i], d);
    if (!t.flat && e * t.per_pixel[i] < -t.reach) {
      inside = by_ties = false;
      border = kInfinity;
      nearest = d;
      w = 1;
      return;
    }
    inside &= e >= 0;
    const auto left_bottom = Conventions::TieRule::left_bottom;  // as exact/coverage.h
    by_ties &= e > 0 || (e == 0 && owns_ties(left_bottom, t.sign * glm::dvec2(t.n[i])));
    border = std::min(border, t.per_pixel[i] > 0 ? e * t.per_pixel[i] : kInfinity);
  }
  const double inv_w = glm::dot(t.w_plane, d);
  if (inside && inv_w > 0) {
    nearest = d;
    w = 1 / inv_w;
    return;
  }
  inside = by_ties = false;
  border = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &v_j = scene.corners[t.corner[(i + 1) % 3]].v, &v_k = scene.corners[t.corner[(i + 2) % 3]].v;
    const EdgeDistance edge = edge_distance(t.n[i], v_j, v_k, d);
    if (edge.pixels < border) {
      border = edge.pixels;
      nearest = edge.d_nearest;
      w = edge.w;
    }
  }
}

// A piece covers the pixel only if, in double, it is within `reach`, its displacement by rounding and snapping.
void PixelSite::find_pieces() {
  const double moved_by = 2 * (t.reach - t.snap);
  const auto thinnest = [&](double of_all, const std::vector<glm::dvec2>& outline) {
    const double here = thinnest_piece(outline, glm::dvec2(d), 2 * t.reach);
    return (std::isfinite(here) ? here : of_all) - moved_by;
  };
  pieces = {thinnest(t.altitude, t.outline), thinnest(t.guarded.altitude, t.guarded.outline)};
  const auto may_lie_in_a_sliver = [&](const std::vector<glm::dvec2>& outline) {
    return std::ranges::any_of(t.may_be_cut_off, [&](const Triangle::MayBeCutOff& from) {
      return std::ranges::any_of(outline, [&](glm::dvec2 to) {
        return distance_to_triangle(glm::dvec2(d), {from.at, to, to}) <= from.reach + 2 * t.reach;
      });
    });
  };
  if (may_lie_in_a_sliver(t.outline) || may_lie_in_a_sliver(t.guarded.outline)) pieces = {0, 0};
}

double PixelSite::snap_weight(bool certain) const {
  // A plane through vertices displaced by up to delta_E, evaluated at a pixel with barycentrics b' in the displaced
  // triangle, has the value of the point sum b'_i v_i, which is within sum |b'_i| delta_E of the pixel. Inside, the sum
  // is 1. Outside by at most a snapping step (coverage is snapped, the plane is not), at most two b' are negative, each
  // by at most the step over the altitude. The pieces of a cut triangle have such borders inside the triangle, too.
  if (certain && !t.cut) return 1;
  const double altitude = pieces.framed;
  return altitude > 0 ? 1 + 4 * t.snap / altitude : kInfinity;
}

// Thin pieces of a cut triangle lie at its border.
bool PixelSite::may_show_either_face(bool certain) const { return t.thin || t.sign == 0 || (t.cut && !certain); }

/// snap_weight() for the pixel's centre where the triangle covers a sample: the centre may be outside of the triangle
/// by the sample's offset.
double PixelSite::centre_weight(bool certain) const {
  const double weight = snap_weight(certain), apart = glm::length(scene.sample);
  if (apart == 0) return weight;
  const double altitude = t.altitude - 2 * (t.reach - t.snap);
  return altitude > 0 ? std::max(weight, 1 + 4 * (t.snap + apart) / altitude) : kInfinity;
}

// Without perspective, each edge function is multiplied by its corner's w; not of a triangle that may be cut
// (error_of_cuts()).
std::array<glm::dvec3, 3> PixelSite::weight_planes(Conventions::Interpolation how) const {
  std::array<glm::dvec3, 3> out = t.n;
  if (how != kAffine || t.cut) return out;
  for (std::size_t i = 0; i < 3; ++i) out[i] *= scene.corners[t.corner[i]].v.z;
  return out;
}

BoundedFour PixelSite::attribute(const std::array<BoundedFour, 3>& corners, bool certain,
                                 Conventions::Interpolation how) const {
  const glm::dvec3 centre = scene.to_centre(d);
  const std::array<glm::dvec3, 3> n = weight_planes(how);
  const glm::dvec3 e(glm::dot(n[0], centre), glm::dot(n[1], centre), glm::dot(n[2], centre));
  const double weight = centre_weight(certain), sum = e.x + e.y + e.z;
  // Without a reliable plane: the mean of the corners, without a bound.
  if (t.flat || !std::isfinite(weight) || !(sum * t.sign > 0) || (how == kAffine && !t.ahead))
    return {(corners[0].value + corners[1].value + corners[2].value) / 3.0, kInfinity};
  const auto largest = [](const glm::dvec4& v) {
    const glm::dvec4 a = glm::abs(v);
    return std::max({a.x, a.y, a.z, a.w});
  };
  glm::dvec4 value(0), slope_x(0), slope_y(0), of_x(0), of_y(0);  // of_x, of_y: slopes of the numerator
  double error = 0, spread = 0, most = 0;
  const glm::dvec3 n_sum = n[0] + n[1] + n[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const double b = e[static_cast<glm::length_t>(i)] / sum;
    value += b * corners[i].value;
    of_x += n[i].x / sum * corners[i].value;
    of_y += n[i].y / sum * corners[i].value;
    slope_x += (n[i].x - b * n_sum.x) / sum * corners[i].value;
    slope_y += (n[i].y - b * n_sum.y) / sum * corners[i].value;
    error = std::max(error, corners[i].bound);
    most = std::max(most, largest(corners[i].value));
  }
  for (const BoundedFour& corner : corners) spread = std::max(spread, largest(corner.value - value));
  // Far from the eye, e_i of a triangle that comes near are small, but have the near end's errors: w / w_min larger.
  // A relative error of 1/w_i, or of the plane of 1/w, moves the value by that share of the spread.
  const double near_end = std::max(w, centre == d ? 0 : 1 / glm::dot(t.w_plane, centre)) / t.w_min;
  const double value_weight = 1 + (weight - 1) * near_end;
  const double w_error = t.roundings * kFloatRounding * t.size.w / t.w_min;
  const bool snapped = scene.conventions.attribute_corners == Conventions::Corners::snapped;
  const glm::dvec2 from_place = weight * moved + (snapped ? weight : may_turn_over(certain) ? 1.0 : 0.0) * t.step;
  // Slopes of numerator and denominator, whose largest values are `most` and 1 times near_end, in units of 1/w here.
  const double of_numerator = most > 0 ? std::hypot(largest(of_x), largest(of_y)) / most : 0,
               of_denominator = std::hypot(n_sum.x, n_sum.y) / std::abs(sum),
               steepest = std::max(of_numerator, of_denominator) / near_end;
  const double shares = near_end * shares_error_in_float(scene, t, centre, pieces, steepest);
  // Slopes are those at the sample: where the plane of 1/w falls over from_place, the value changes faster.
  const double falls = (std::abs(n_sum.x) * from_place.x + std::abs(n_sum.y) * from_place.y) / std::abs(sum);
  const double faster = !snapped ? 1 : falls < 1 ? 1 / (1 - falls) : kInfinity;
  const double by_place = largest(slope_x) * from_place.x + largest(slope_y) * from_place.y;
  return {value, (by_place > 0 ? faster * by_place : 0) + attribute_error(shares, most) +
                     value_weight * (error + 2 * (w_error + error_of_cuts(scene, t, how)) * spread +
                                     32 * kFloatRounding * near_end * std::max(most, 1.0))};
}

double PixelSite::slopes_off() const {
  const bool snapped = scene.conventions.attribute_corners == Conventions::Corners::snapped;
  const double altitude = pieces.framed, by = glm::length(moved) + (snapped ? t.snap : 0);
  const double of_w = t.roundings * kFloatRounding * t.size.w / t.w_min;
  constexpr double kAnything = 1e30;
  return altitude > 0 ? std::min(4 * by / altitude + 4 * of_w + 16 * kFloatRounding, kAnything) : kAnything;
}

}  // namespace plumbline::math

#include "reference/oracle/pixel_hit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/arithmetic/color_error.h"
#include "reference/arithmetic/error_in_float.h"
#include "reference/arithmetic/fog.h"
#include "reference/arithmetic/light_bounds.h"
#include "reference/arithmetic/texture.h"

namespace plumbline::math {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Place {
  bool inside = false;    ///< in the closed triangle, in double
  bool by_ties = false;   ///< inside, with edges by the tie rule
  double border = 0;      ///< distance to the triangle's border [pixels]
  glm::dvec3 nearest{0};  ///< the point of the triangle nearest to d
  double w = 0;           ///< clip w at `nearest`
};

/// Least altitude of the pieces for which a renderer may set up a plane at this pixel [pixels].
double piece_altitude(const Projected& scene, const Triangle& t, const Place& at, glm::dvec3 d, bool certain) {
  // Three corners of a convex polygon that are nearly in line lie along its border: such a piece reaches no pixel that
  // is deep inside, far from the triangle's edges, the near and far cuts, and the frame's border (half a pixel away).
  const double margin = 4 * t.reach, z = 0.5 + glm::dot(t.z_plane, d);
  const double from_frame = 0.5 - std::max(std::abs(scene.sample.x), std::abs(scene.sample.y));
  const bool deep = certain && at.border > margin && margin < from_frame &&
                    std::min(z, 1 - z) > margin * glm::length(glm::dvec2(t.z_plane));
  return (deep ? t.fat_altitude : t.altitude) - 2 * (t.reach - scene.snap);
}

/// S: factor by which the errors of a plane's corners may grow at a pixel of its triangle; infinite: without bound.
double snap_weight(const Projected& scene, const Triangle& t, const Place& at, glm::dvec3 d, bool certain) {
  // A plane is set up through vertices within delta_E of their places, and evaluated at the pixel. With b' the pixel's
  // barycentrics in the moved triangle, it comes to z at sum b'_i v_i, which is within sum |b'_i| delta_E of the pixel.
  // Inside, that sum is 1. Outside by at most a snapping step (coverage is snapped, the plane is not), at most two b'
  // are negative, each by no more than the step over the altitude. A triangle that is cut is drawn in pieces, which
  // have such borders inside it too.
  if (certain && !t.cut) return 1;
  const double altitude = piece_altitude(scene, t, at, d, certain);
  return altitude > 0 ? 1 + 4 * scene.snap / altitude : kInfinity;
}

/// snap_weight() for the pixel's centre where the triangle covers a sample: the centre may be outside of the triangle
/// by the sample's offset.
double centre_weight(const Projected& scene, const Triangle& t, const Place& at, glm::dvec3 d, bool certain) {
  const double weight = snap_weight(scene, t, at, d, certain), apart = glm::length(scene.sample);
  if (apart == 0) return weight;
  const double altitude = t.altitude - 2 * (t.reach - scene.snap);
  return altitude > 0 ? std::max(weight, 1 + 4 * (scene.snap + apart) / altitude) : kInfinity;
}

Place place(const Projected& scene, const Triangle& t, glm::dvec3 d) {
  Place out;
  out.inside = out.by_ties = !t.flat;
  out.border = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const double e = t.sign * glm::dot(t.n[i], d);
    if (!t.flat && e * t.per_pixel[i] < -t.reach) return {false, false, kInfinity, d, 1};
    out.inside &= e >= 0;
    const auto left_bottom = Conventions::TieRule::left_bottom;  // what a float renderer of OpenGL's conventions has
    out.by_ties &= e > 0 || (e == 0 && owns_ties(left_bottom, t.sign * glm::dvec2(t.n[i])));
    out.border = std::min(out.border, t.per_pixel[i] > 0 ? e * t.per_pixel[i] : kInfinity);
  }
  const double inv_w = glm::dot(t.w_plane, d);
  if (out.inside && inv_w > 0) {
    out.nearest = d;
    out.w = 1 / inv_w;
    return out;
  }
  out.inside = out.by_ties = false;
  out.border = kInfinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &v_j = scene.corners[t.corner[(i + 1) % 3]].v, &v_k = scene.corners[t.corner[(i + 2) % 3]].v;
    const EdgeDistance edge = edge_distance(t.n[i], v_j, v_k, d);
    if (edge.pixels < out.border) {
      out.border = edge.pixels;
      out.nearest = edge.d_nearest;
      out.w = edge.w;
    }
  }
  return out;
}

/// Sets the depth interval in the window, from that of z_view: two further roundings, unless the depth range is [0,1],
/// whose rounding is counted already.
/// `in_float`: error_in_float().
void set_window_depth(const Triangle& t, bool clamps, double lo, double hi, double weight, double in_float,
                      PixelHit& out) {
  const double moved = t.range == DepthRange{} ? 0 : 2 * weight * kFloatRounding, scale = range_scale(t);
  const double rounding = moved + t.offset.half + in_float;
  const auto [low, high] = clamps ? std::minmax({double{t.range.near}, double{t.range.far}}) : std::pair(0.0, 1.0);
  out.win.z = to_window(t, out.view.z);
  if (clamps) out.win.z = std::clamp(out.win.z, low, high);
  out.win.half = scale * out.view.half + rounding;
  out.win.slope = (double{t.range.far} - double{t.range.near}) * out.view.slope;
  if (!std::isfinite(rounding)) {
    out.hit.z_lo = low;
    out.hit.z_hi = high;
    return;
  }
  const auto [nearest, farthest] = std::minmax({to_window(t, lo), to_window(t, hi)});
  out.hit.z_lo = std::clamp(nearest - rounding, low, high);
  out.hit.z_hi = std::clamp(farthest + rounding, low, high);
}

/// Sets the depth interval: the plane's z at the pixel, displaced by at most h + delta_E where coverage and plane are
/// snapped alike, or by the plane's own error where only coverage is snapped; plus the corners' depth error.
void set_depth(const Projected& scene, const Triangle& t, glm::dvec3 d, const Place& at, glm::dvec2 moved,
               PixelHit& out) {
  const bool clamps = scene.depth_clamp;
  const double weight = snap_weight(scene, t, at, d, out.hit.certain);
  const double w = std::clamp(at.w, t.w_min, t.w_max);
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
  view.z = 0.5 + glm::dot(t.z_plane, d);
  view.slope = glm::dvec2(t.z_plane);
  const double from_middle = std::abs(2 * view.z - 1), z_ndc = clamps ? from_middle : std::min(from_middle, 1.0);
  const double corner_error = kFloatRounding * (t.roundings * (t.size.z + z_ndc * t.size.w) / (2 * w) + 1);
  view.half = glm::dot(glm::abs(view.slope), scene.step + weight * moved) + weight * corner_error;
  double lo = view.z - view.half, hi = view.z + view.half;
  const bool not_cut = clamps || (lo > 0 && hi < 1);  // by the near or far plane, here
  out.whole = out.whole || (t.facing_kept && not_cut);
  // Inside, every plane comes to a convex combination of the corners' depths; outside it may overshoot them.
  if (out.hit.certain && t.ahead) {
    lo = std::max(lo, t.z_min - corner_error);
    hi = std::min(hi, t.z_max + corner_error);
  }
  out.hit.certain = out.hit.certain && not_cut;
  set_window_depth(t, clamps, lo, hi, weight,
                   error_in_float(scene, t, d, piece_altitude(scene, t, at, d, out.hit.certain)), out);
}

/// Gradients of the edge functions that weight attributes: where a renderer interpolates without perspective, each is
/// multiplied by its corner's w.
std::array<glm::dvec3, 3> weight_planes(const Projected& scene, const Triangle& t) {
  std::array<glm::dvec3, 3> out = t.n;
  if (scene.conventions.interpolation == Conventions::Interpolation::perspective) return out;
  for (std::size_t i = 0; i < 3; ++i) out[i] *= scene.corners[t.corner[i]].v.z;
  return out;
}

/// Whether a renderer interpolates without perspective between corners that a cut made: then no bound holds.
bool is_affine_and_cut(const Projected& scene, const Triangle& t) {
  return scene.conventions.interpolation == Conventions::Interpolation::affine && (t.cut || !t.ahead);
}

/// An attribute at the pixel's centre, with its bound, by the renderer's interpolation; extrapolated beyond the
/// triangle's border, as renderers do. `corners`: the attribute at the corners.
BoundedFour at_pixel(const Projected& scene, const Triangle& t, const std::array<BoundedFour, 3>& corners, glm::dvec3 d,
                     const Place& at, glm::dvec2 moved, bool certain) {
  const glm::dvec3 centre = scene.to_centre(d);
  const std::array<glm::dvec3, 3> n = weight_planes(scene, t);
  const glm::dvec3 e(glm::dot(n[0], centre), glm::dot(n[1], centre), glm::dot(n[2], centre));
  const double weight = centre_weight(scene, t, at, d, certain), sum = e.x + e.y + e.z;
  // No reliable plane.
  if (t.flat || !std::isfinite(weight) || !(sum * t.sign > 0) || is_affine_and_cut(scene, t))
    return {(corners[0].value + corners[1].value + corners[2].value) / 3.0, kInfinity};
  const auto largest = [](const glm::dvec4& v) {
    const glm::dvec4 a = glm::abs(v);
    return std::max({a.x, a.y, a.z, a.w});
  };
  glm::dvec4 value(0), slope_x(0), slope_y(0);
  double error = 0, spread = 0, size = 1;
  const glm::dvec3 n_sum = n[0] + n[1] + n[2];
  for (std::size_t i = 0; i < 3; ++i) {
    const double b = e[static_cast<glm::length_t>(i)] / sum;
    value += b * corners[i].value;
    slope_x += (n[i].x - b * n_sum.x) / sum * corners[i].value;
    slope_y += (n[i].y - b * n_sum.y) / sum * corners[i].value;
    error = std::max(error, corners[i].bound);
    size = std::max(size, largest(corners[i].value));
  }
  for (const BoundedFour& corner : corners) spread = std::max(spread, largest(corner.value - value));
  // A far point of a triangle that comes near has small e_i: their errors are those of the near end, w / w_min larger.
  // The relative error of 1/w_i moves the value by its share of the spread, and so does that of w's plane.
  const double w = std::max(std::clamp(at.w, t.w_min, t.w_max), centre == d ? 0 : 1 / glm::dot(t.w_plane, centre));
  const double near_end = w / t.w_min;
  const double value_weight = 1 + (weight - 1) * near_end;
  const double w_error = t.roundings * kFloatRounding * t.size.w / t.w_min;
  // A piece of a cut triangle may be so thin that snapping turns it over; its plane then goes through snapped corners.
  const bool turned = !certain && (t.cut || t.thin);
  const bool snapped = scene.conventions.attribute_corners == Conventions::Corners::snapped;
  const glm::dvec2 from_place = weight * moved + (snapped ? weight * scene.step : turned ? scene.step : 0);
  return {value, largest(slope_x) * from_place.x + largest(slope_y) * from_place.y +
                     value_weight * (error + 2 * w_error * spread + 32 * kFloatRounding * near_end * size)};
}

/// Relative error of a renderer's slopes of attributes: corners displaced by float arithmetic or snapping tilt a plane
/// by the displacement over its altitude; w adds its own error, the evaluation 16 u.
double slopes_off(const Projected& scene, const Triangle& t, glm::dvec2 moved, bool certain) {
  const bool snapped = scene.conventions.attribute_corners == Conventions::Corners::snapped;
  const double altitude = certain ? t.fat_altitude : t.altitude, by = glm::length(moved) + (snapped ? scene.snap : 0);
  const double of_w = t.roundings * kFloatRounding * t.size.w / t.w_min;
  constexpr double kAnything = 1e30;
  return altitude > 0 ? std::min(4 * by / altitude + 4 * of_w + 16 * kFloatRounding, kAnything) : kAnything;
}

/// The hit's texture coordinates, and the range of lambda over the four pixels of its 2 x 2 quad, by ray differentials:
/// d b_i / dx = (n_i.x - b_i sum_j n_j.x) / sum_j e_j. `off`: relative error of the derivatives.
BoundedPlace place_in_texture(const Texture& texture, const Triangle& t, const std::array<glm::dvec2, 3>& texcoords,
                              const BoundedFour& st, glm::dvec3 d, glm::ivec2 pixel, const LevelRules& rules,
                              double off) {
  BoundedPlace out{glm::dvec2(st.value), st.bound, 0, kInfinity, -kInfinity};
  const glm::dvec3 n_sum = t.n[0] + t.n[1] + t.n[2];
  const double least_off = std::max(1 - off, 0.0);
  for (int k = 0; k < 4; ++k) {
    const glm::ivec2 at((pixel.x & ~1) + k % 2, (pixel.y & ~1) + k / 2);
    const glm::dvec3 ray = d + glm::dvec3(glm::dvec2(at - pixel), 0);
    const glm::dvec3 e(glm::dot(t.n[0], ray), glm::dot(t.n[1], ray), glm::dot(t.n[2], ray));
    const double sum = e.x + e.y + e.z;
    glm::dvec2 d_dx(0), d_dy(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const double b = e[static_cast<glm::length_t>(i)] / sum;
      d_dx += (t.n[i].x - b * n_sum.x) / sum * texcoords[i];
      d_dy += (t.n[i].y - b * n_sum.y) / sum * texcoords[i];
    }
    const bool ahead = sum * t.sign > 0;
    const double lambda = ahead ? level_of_detail(texture, d_dx, d_dy) : static_cast<double>(texture.sampler.max_lod);
    const double least = ahead ? smallest_level_of_detail(texture, least_off * d_dx, least_off * d_dy, rules)
                               : static_cast<double>(texture.sampler.min_lod);
    const double most = ahead ? largest_level_of_detail(texture, (1 + off) * d_dx, (1 + off) * d_dy, rules) : lambda;
    if (at == pixel) out.lambda = lambda;
    out.lambda_lo = std::min(out.lambda_lo, least);
    out.lambda_hi = std::max(out.lambda_hi, most);
  }
  return out;
}

/// Largest excess of a colour beyond [0,1] in channels that are within [0,1] at all corners: by extrapolation beyond
/// the triangle, where a renderer may clamp or not.
double overshoot(const glm::dvec4& color, const std::array<BoundedFour, 3>& corners) {
  double out = 0;
  for (glm::length_t c = 0; c < 4; ++c) {
    const auto is_within = [&](const BoundedFour& of) { return of.value[c] >= 0 && of.value[c] <= 1; };
    if (std::ranges::all_of(corners, is_within)) out = std::max(out, std::max(color[c] - 1, -color[c]));
  }
  return out;
}

/// Sets the fragment's colour and its bound, from its attributes at the pixel.
void set_color(const Scene& scene, const Projected& projected, const Triangle& t, glm::dvec3 d, glm::ivec2 pixel,
               const Place& at, glm::dvec2 moved, PixelHit& out) {
  const Draw& draw = scene.draws[t.draw];
  const auto corner = [&](std::size_t i) -> const Corner& { return projected.corners[t.corner[i]]; };
  const auto attribute = [&](auto of_corner) {
    return at_pixel(projected, t, {of_corner(corner(0)), of_corner(corner(1)), of_corner(corner(2))}, d, at, moved,
                    out.hit.certain);
  };
  const LightModel& model = scene.light_model;
  const bool two = draw.lit && model.sides == LightModel::Sides::two, back = two && t.sign < 0;
  const auto lit_part = [&](auto of_corner) {
    if (draw.shading != Shading::flat) {
      BoundedFour smooth = attribute(of_corner);
      smooth.bound += overshoot(smooth.value, {of_corner(corner(0)), of_corner(corner(1)), of_corner(corner(2))});
      return smooth;
    }
    BoundedFour last = of_corner(corner(2));
    last.bound += 4 * kFloatRounding;
    return last;
  };
  BoundedFour color = lit_part([&](const Corner& c) {
    return back && is_lit_per_vertex(draw) ? BoundedFour{c.back_color, c.back_color_error}
                                           : BoundedFour{c.color, c.color_error};
  });
  BoundedFour secondary;
  if (is_lit_per_vertex(draw) && model.separate_specular) {
    secondary = lit_part([&](const Corner& c) {
      return back ? BoundedFour{c.back_secondary, c.back_secondary_error} : BoundedFour{c.secondary, c.secondary_error};
    });
  }
  if (is_lit_per_fragment(draw)) {
    const BoundedFour p = attribute([](const Corner& c) { return BoundedFour{glm::dvec4(c.p_eye, 0), c.p_eye_error}; });
    const BoundedFour n = attribute([](const Corner& c) { return BoundedFour{glm::dvec4(c.n_eye, 0), c.n_eye_error}; });
    const Known p_eye{glm::dvec3(p.value), p.bound};
    Known n_eye = unit({glm::dvec3(n.value), n.bound});
    if (back) n_eye.v = -n_eye.v;
    const bool follows = draw.color_material != ColorMaterial::none && !scene.meshes[draw.mesh].colors.empty();
    const bool known = std::isfinite(p.bound + n_eye.error + color.bound) && n_eye.error < 1;
    const auto of_fragment = [&](bool specular) {
      const DoubleMaterial material = material_of(scene, draw, {back, specular}, color.value);
      const double bound =
          known ? light_error(scene, material, {glm::dvec4(p_eye.v, 1), glm::dvec4(0), n_eye.v},
                              {p_eye.error, n_eye.error, follows ? color.bound : 0, projected.light_errors},
                              projected.lights)
                : kInfinity;
      return BoundedFour{light(scene, material, projected.lights, p_eye.v, n_eye.v), bound};
    };
    if (model.separate_specular) secondary = of_fragment(true);
    color = of_fragment(false);
  }
  if (draw.texture) {
    const BoundedFour st = attribute([](const Corner& c) { return BoundedFour{glm::dvec4(c.texcoord, 0, 0), 0}; });
    const Texture& texture = scene.textures.at(draw.texture->texture);
    const LevelRules rules = level_rules(projected.conventions);
    const BoundedPlace place =
        place_in_texture(texture, t, {corner(0).texcoord, corner(1).texcoord, corner(2).texcoord}, st,
                         projected.to_centre(d), pixel, rules, slopes_off(projected, t, moved, out.hit.certain));
    color = bounded_textured_color(texture, *draw.texture, color, place, rules);
  }
  if (draw.lit && model.separate_specular) {
    color = {color_sum(color.value, secondary.value), color.bound + secondary.bound + kFloatRounding};
  }
  if (two && (t.thin || t.sign == 0)) color.bound = kInfinity;  // it may show either face
  if (draw.fog && std::isfinite(color.bound)) {
    const auto z_eye = [](const Corner& c) { return BoundedFour{glm::dvec4(0, 0, c.z_eye, 0), c.z_eye_error}; };
    const BoundedFour p = attribute(z_eye);
    const double f_error =
        std::isfinite(p.bound) ? std::min(1.0, fog_factor(*draw.fog, {p.value.z, p.bound}, {16}).error) : 1;
    const glm::dvec3 from_fog = glm::abs(glm::dvec3(color.value) - glm::dvec3(draw.fog->color));
    color.bound += f_error * (std::max({from_fog.x, from_fog.y, from_fog.z}) + color.bound) + 4 * kFloatRounding;
    color.value = fogged(*draw.fog, color.value, p.value.z);
  }
  out.hit.color = color.value;
  out.hit.color_bound = color.bound;
}

}  // namespace

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

void color_hit(const Scene& scene, const Projected& projected, int px, int py, PixelHit& hit) {
  if (hit.colored) return;
  const Triangle& t = projected.triangles[hit.hit.primitive];
  const glm::dvec3 d = projected.ray(px, py);
  const Place at = place(projected, t, d);
  const glm::dvec2 moved = float_displacement(projected, t, at.nearest, std::clamp(at.w, t.w_min, t.w_max));
  set_color(scene, projected, t, d, {px, py}, at, moved, hit);
  hit.colored = true;
}

std::optional<PixelHit> pixel_hit(const Scene& scene, const Projected& projected, std::uint32_t primitive, int px,
                                  int py, Colors colors) {
  const Triangle& t = projected.triangles[primitive];
  if (!t.drawn) return std::nullopt;
  const std::optional<Scissor>& scissor = scene.draws[t.draw].scissor;
  if (scissor && !scissor->holds(px, py)) return std::nullopt;
  const glm::dvec3 d = projected.ray(px, py);
  const Place at = place(projected, t, d);
  if (!at.inside && !t.loose && !(at.border <= t.reach)) return std::nullopt;
  const double w = std::clamp(at.w, t.w_min, t.w_max);
  const glm::dvec2 moved = float_displacement(projected, t, at.nearest, w);
  PixelHit out;
  // A triangle seen edge on may, by rounding, cover a pixel by its part nearest to the eye.
  out.delta = t.flat ? t.reach : std::min(t.reach, projected.snap + t.growth * glm::length(moved));
  if (!at.inside && !t.loose && at.border > out.delta) return std::nullopt;
  out.hit.primitive = primitive;
  out.hit.depth_func = scene.draws[t.draw].depth_func;
  out.hit.depth_mask = scene.draws[t.draw].merge.depth_mask;
  out.hit.certain = at.inside && at.border > out.delta && !t.thin;
  // A side plane cuts an edge that two triangles share: each rounds the new corner, down or up, perhaps to another grid
  // point.
  const bool apart = t.cut && projected.conventions.subpixel_rounding != Conventions::Rounding::nearest;
  out.whole = t.facing_kept && !t.flat && !t.cut;
  set_depth(projected, t, d, at, moved, out);
  out.whole = out.whole && !apart;
  const PixelDepth& view = out.view;
  if (!scene.depth_clamp && std::isfinite(view.half) && (view.z + view.half < 0 || view.z - view.half > 1))
    return std::nullopt;
  out.colored = colors == Colors::now || scene.draws[t.draw].alpha_test.has_value();
  if (out.colored) set_color(scene, projected, t, d, {px, py}, at, moved, out);
  set_tests(scene.draws[t.draw], t, scene.frame, projected.conventions, out);
  if (!out.hit.certain) out.covers = known_coverage(projected, t, px, py);
  out.inside = out.covers.value_or(at.by_ties && at.inside && t.facing_kept) &&
               (scene.depth_clamp || (view.z >= 0 && view.z <= 1));
  return out;
}

}  // namespace plumbline::math

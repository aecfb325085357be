// The colour of a hit, with its bound.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "capture/by_conventions.h"
#include "reference/arithmetic/color_error.h"
#include "reference/arithmetic/fog.h"
#include "reference/arithmetic/light_bounds.h"
#include "reference/arithmetic/texture.h"
#include "reference/oracle/pixel_hit.h"
#include "reference/oracle/pixel_site.h"

namespace plumbline::math {

namespace {

/// Derivatives [1 / pixel] of the hit's texture coordinates, from edge functions `planes`: d b_i / dx = (n_i.x - b_i
/// sum_j n_j.x) / sum_j e_j. None: the ray meets the triangle's plane behind the eye.
struct Derivatives {
  glm::dvec2 along_x, along_y;
};
std::optional<Derivatives> derivatives(const PixelSite& site, const std::array<glm::dvec3, 3>& planes, glm::dvec3 ray) {
  const glm::dvec3 e(glm::dot(planes[0], ray), glm::dot(planes[1], ray), glm::dot(planes[2], ray));
  const glm::dvec3 n_sum = planes[0] + planes[1] + planes[2];
  const double sum = e.x + e.y + e.z;
  if (!(sum * site.t.sign > 0)) return std::nullopt;
  Derivatives out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double b = e[static_cast<glm::length_t>(i)] / sum;
    const glm::dvec2 texcoord = site.scene.corners[site.t.corner[i]].texcoord;
    out.along_x += (planes[i].x - b * n_sum.x) / sum * texcoord;
    out.along_y += (planes[i].y - b * n_sum.y) / sum * texcoord;
  }
  return out;
}

/// The hit's texture coordinates, and the range of lambda over the four pixels of its 2 x 2 quad. `off`: relative error
/// of the derivatives. A renderer that interpolates without perspective may take derivatives of what it interpolates,
/// or those of the surface.
BoundedPlace place_in_texture(const Texture& texture, const PixelSite& site, const BoundedFour& st,
                              const LevelRules& rules, double off) {
  const glm::ivec2 pixel = site.pixel;
  const glm::dvec3 centre = site.scene.to_centre(site.d);
  BoundedPlace out{glm::dvec2(st.value), glm::dvec2(st.bound), 0, kInfinity, -kInfinity};
  for (glm::length_t k = 0; k < 2; ++k) {  // a coordinate that is 0 at all corners is 0 in any arithmetic
    const auto is_0 = [&](std::uint32_t corner) { return site.scene.corners[corner].texcoord[k] == 0; };
    if (std::isfinite(st.bound) && std::ranges::all_of(site.t.corner, is_0)) out.bound[k] = 0;
  }
  const double least_off = std::max(1 - off, 0.0);
  for (int k = 0; k < 4; ++k) {
    const glm::ivec2 at((pixel.x & ~1) + k % 2,
                        lower_row_of_square(site.scene.conventions.rows, site.scene.height, pixel.y) + k / 2);
    const glm::dvec3 ray = centre + glm::dvec3(glm::dvec2(at - pixel), 0);
    for (const bool of_surface : {false, true}) {
      const auto planes = of_surface ? site.t.n : site.weight_planes(site.scene.conventions.interpolation);
      const auto d = site.has_one_plane() ? derivatives(site, planes, ray) : std::nullopt;
      double lambda = static_cast<double>(texture.sampler.max_lod), most = lambda,
             least = static_cast<double>(texture.sampler.min_lod);
      if (d) {
        lambda = level_of_detail(texture, d->along_x, d->along_y);
        least = smallest_level_of_detail(texture, least_off * d->along_x, least_off * d->along_y, rules);
        most = largest_level_of_detail(texture, (1 + off) * d->along_x, (1 + off) * d->along_y, rules);
      }
      if (at == pixel && !of_surface) out.lambda = lambda;
      out.lambda_lo = std::min(out.lambda_lo, least);
      out.lambda_hi = std::max(out.lambda_hi, most);
      if (planes == site.t.n) break;
    }
  }
  return out;
}

/// Largest excess beyond [0,1] of the channels that lie within [0,1] at all corners. Extrapolation beyond the triangle
/// makes such an excess; a renderer may clamp it or not.
double overshoot(const glm::dvec4& color, const std::array<BoundedFour, 3>& corners) {
  double out = 0;
  for (glm::length_t c = 0; c < 4; ++c) {
    const auto is_within = [&](const BoundedFour& of) { return of.value[c] >= 0 && of.value[c] <= 1; };
    if (std::ranges::all_of(corners, is_within)) out = std::max(out, std::max(color[c] - 1, -color[c]));
  }
  return out;
}

constexpr double kThree = std::numbers::sqrt3;  // length of a vector of three components of 1

/// Length of a vector. Three squares, two sums and a root round by at most 4 u.
Bounded length_of(const BoundedVector& a) {
  const double length = glm::length(a.v);
  return {length, a.error + 4 * kFloatRounding * length};
}

/// Distance of fog at a corner [eye units]: z_eye, which is negative before the eye, or the length of p_eye.
Bounded fog_distance(const Projected& scene, const Corner& c) {
  const bool is_radial = scene.conventions.fog_distance == Conventions::FogDistance::eye_radial;
  return is_radial ? length_of({c.p_eye, c.p_eye_error}) : Bounded{c.z_eye, c.z_eye_error};
}

/// Factors of fog that a fragment may have.
struct FactorRange {
  double least = kInfinity, most = -kInfinity;
  void include(double factor) { least = std::min(least, factor), most = std::max(most, factor); }
};

// Includes the factors that pieces of a cut triangle may interpolate at a fragment of that distance [eye units]. The
// distances of pieces' corners lie in [near, far]: from the triangle's nearest |z_eye|, or the near plane's cut, to its
// farthest corner. A convex factor of |z_eye| lies between the fragment's own and the chord over [near, far]. Where the
// factor is not convex (exp2; linear fog about its start; across the eye's plane), or |p_eye| is the distance, which is
// not linear over a piece, the whole range is legal.
void include_factors_of_pieces(FactorRange& factors, const Fog& fog, const PixelSite& site, double distance) {
  const auto z_eye = [&](std::uint32_t corner) { return site.scene.corners[corner].z_eye; };
  const auto [low, high] = std::ranges::minmax(site.t.corner, {}, z_eye);
  const bool is_about_eye = z_eye(low) < 0 && z_eye(high) > 0;
  const bool is_radial = site.scene.conventions.fog_distance == Conventions::FogDistance::eye_radial;
  const auto distance_of = [&](std::uint32_t corner) {
    return std::abs(fog_distance(site.scene, site.scene.corners[corner]).value);
  };
  const double far =
      std::ranges::max({distance_of(site.t.corner[0]), distance_of(site.t.corner[1]), distance_of(site.t.corner[2])});
  double near = is_about_eye ? 0 : std::min(std::abs(z_eye(low)), std::abs(z_eye(high)));
  near = std::max(near, site.scene.distance_per_w * site.t.guarded.w_min);
  const auto factor_at = [&](double d) { return fog_factor(fog, {d, 0}, {16}).value; };
  const double share = far > near ? std::clamp((distance - near) / (far - near), 0.0, 1.0) : 0;
  factors.include(glm::mix(factor_at(near), factor_at(far), share));
  const bool starts = fog.mode == Fog::Mode::linear && near < fog.start && fog.start < far;
  if (fog.mode == Fog::Mode::exp2 || starts || is_radial || (is_about_eye && near == 0))
    factors.include(factor_at(near)), factors.include(factor_at(far));
}

/// The colours of one draw's fragments at a site.
class FragmentColor {
 public:
  FragmentColor(const Scene& scene, const PixelSite& site, bool certain)
      : scene_(scene), site_(site), draw_(scene.draws[site.t.draw]), certain_(certain) {}

  /// The colour and its bound after all stages up to fog.
  BoundedFour color() const;
  /// True if alpha is 0 in any arithmetic: at all corners, and no texture replaces it.
  bool has_no_alpha() const;
  /// Error of alpha in alpha tests beyond the colour's: the last rounding to codes, which color() leaves to the frame.
  double rounding_of_alpha() const;

 private:
  bool is_two_sided() const { return draw_.lit && scene_.light_model.sides == LightModel::Sides::two; }
  bool is_back() const { return is_two_sided() && site_.t.sign < 0; }
  // of_corner(): the attribute at each corner.
  BoundedFour attribute(auto of_corner) const {
    return site_.attribute(at_corners(of_corner), certain_, site_.scene.conventions.interpolation);
  }
  std::array<BoundedFour, 3> at_corners(auto of_corner) const {
    const auto corner = [&](std::size_t i) { return of_corner(site_.scene.corners[site_.t.corner[i]]); };
    return {corner(0), corner(1), corner(2)};
  }
  // Vertex colour at the site, smooth or flat. A renderer that declares float arithmetic may interpolate three equal
  // corners, too.
  BoundedFour of_vertices(auto of_corner) const {
    std::array<BoundedFour, 3> corners = at_corners(of_corner);
    for (BoundedFour& corner : corners) corner.bound += rounding_of_vertex(corner);
    const bool is_flat = draw_.shading == Shading::flat;
    if (is_flat) corners[0] = corners[1] = corners[2];
    const bool is_given =
        is_flat && site_.scene.conventions.depth_arithmetic == Conventions::DepthArithmetic::in_double;
    BoundedFour out =
        is_given ? corners[2] : site_.attribute(corners, certain_, interpolation_of_colors(site_.scene.conventions));
    out.bound += is_flat ? 4 * kFloatRounding : overshoot(out.value, corners);
    return out;
  }
  // Replaces the colour and, with separate specular, the secondary colour by the colours that the fragment is lit to.
  void light_fragment(BoundedFour& color, BoundedFour& secondary) const;
  BoundedFour textured(const BoundedFour& color) const;
  void fog(BoundedFour& color) const;
  // Error of a corner's colour by rounding to a code; 0 where vertex colours are no codes, or this one is already.
  // Each plane that cuts rounds once more.
  double rounding_of_vertex(const BoundedFour& color) const;
  // True if each channel may be a code, by the colour's bound.
  bool is_code(const BoundedFour& color) const;
  // Half a code, where fragments' colours are codes; else 0.
  double half_code() const;
  // True if the last rounding counts: the colour is blended or encoded. Else the frame rounds a code to itself.
  bool counts_last() const;
  // Adds the error of rounding to codes. `has_side`: rounding down or up shifts the colour to that side, else either
  // way.
  void round(BoundedFour& color, double half, bool has_side = true) const;
  // Fog factor at the fragment.
  Bounded fog_factor_there() const;
  /// Factor of fog of vertices, interpolated. `of_fragment`: of a fragment at this distance from the eye [eye units].
  Bounded factor_of_vertices(const Bounded& of_fragment, double distance) const;

  const Scene& scene_;
  const PixelSite& site_;
  const Draw& draw_;
  bool certain_;
};

BoundedFour FragmentColor::color() const {
  const bool back = is_back(), separate = scene_.light_model.separate_specular;
  BoundedFour color = of_vertices([&](const Corner& c) {
    return back && is_lit_per_vertex(draw_) ? BoundedFour{c.back_color, c.back_color_error}
                                            : BoundedFour{c.color, c.color_error};
  });
  BoundedFour secondary;
  if (is_lit_per_vertex(draw_) && separate) {
    secondary = of_vertices([&](const Corner& c) {
      return back ? BoundedFour{c.back_secondary, c.back_secondary_error} : BoundedFour{c.secondary, c.secondary_error};
    });
  }
  if (is_lit_per_fragment(draw_)) light_fragment(color, secondary);
  const bool adds = draw_.lit && separate;
  const double half = half_code(), of_last = counts_last() ? half : 0, before_sum = draw_.fog || adds ? half : of_last,
               before_texture = draw_.texture ? half : before_sum;
  round(color, before_texture), round(secondary, before_texture);
  if (draw_.texture) {
    using enum TextureEnvironment;
    const TextureEnvironment environment = draw_.texture->environment;
    color = textured(color);
    round(color, half, environment == modulate || environment == replace);  // of the texel, times at most 1
    if (environment == blend) round(color, half, false);                    // of the environment's colour
    round(color, before_sum);
  }
  if (adds) color = {color_sum(color.value, secondary.value), color.bound + secondary.bound + kFloatRounding};
  if (is_two_sided() && site_.may_show_either_face(certain_)) color.bound = kInfinity;
  if (draw_.fog && std::isfinite(color.bound)) {
    fog(color);
    round(color, of_last);
  }
  return color;
}

double FragmentColor::rounding_of_vertex(const BoundedFour& color) const {
  if (!has_codes_of_vertices(scene_.frame, site_.scene.conventions)) return 0;
  const double scale = color_scale(scene_.frame.color);
  return ((is_code(color) ? 0 : 1) + site_.t.cuts) * 0.5 / scale;
}

bool FragmentColor::is_code(const BoundedFour& color) const {
  const double scale = color_scale(scene_.frame.color);
  const glm::dvec4 codes = scale * color.value, off = glm::abs(codes - glm::round(codes));
  return glm::all(glm::lessThanEqual(off, glm::dvec4(scale * (color.bound + 4 * kFloatRounding))));
}

double FragmentColor::half_code() const {
  const bool are_codes = has_codes_of_fragments(scene_.frame, site_.scene.conventions);
  return are_codes ? 0.5 / color_scale(scene_.frame.color) : 0;
}

bool FragmentColor::counts_last() const {
  return draw_.merge.blend || site_.scene.conventions.color_encoding == Conventions::Encoding::srgb;
}

void FragmentColor::round(BoundedFour& color, double half, bool has_side) const {
  const double middle = 2 * middle_of(site_.scene.conventions.color_rounding);  // [half codes]
  // The nearest code of a code is itself. (Rounded down, a code less float's error is the code below.)
  if (half > 0 && middle == 0 && is_code(color) && color.bound < half / 4) return;
  if (has_side) color.value -= middle * half;
  color.bound += has_side ? half : (1 + std::abs(middle)) * half;
}

double FragmentColor::rounding_of_alpha() const {
  const bool is_compared_so = site_.scene.conventions.alpha_test != Conventions::AlphaTest::in_codes;
  return is_compared_so && !counts_last() ? 2 * half_code() : 0;
}

bool FragmentColor::has_no_alpha() const {
  const bool keeps_0 = !draw_.texture || draw_.texture->environment == TextureEnvironment::modulate ||
                       draw_.texture->environment == TextureEnvironment::decal;
  const auto is_0 = [&](std::size_t i) {
    const Corner& c = site_.scene.corners[site_.t.corner[i]];
    return c.color.a == 0 && (!is_two_sided() || c.back_color.a == 0);
  };
  return keeps_0 && !is_lit_per_fragment(draw_) && is_0(0) && is_0(1) && is_0(2);
}

void FragmentColor::light_fragment(BoundedFour& color, BoundedFour& secondary) const {
  const BoundedFour p = attribute([](const Corner& c) { return BoundedFour{glm::dvec4(c.p_eye, 0), c.p_eye_error}; });
  const BoundedFour n = attribute([](const Corner& c) { return BoundedFour{glm::dvec4(c.n_eye, 0), c.n_eye_error}; });
  const BoundedVector p_eye{glm::dvec3(p.value), kThree * p.bound};
  BoundedVector n_eye = unit({glm::dvec3(n.value), kThree * n.bound});
  if (is_back()) n_eye.v = -n_eye.v;
  const bool follows = draw_.color_material != ColorMaterial::none && !scene_.meshes[draw_.mesh].colors.empty();
  const bool known = std::isfinite(p.bound + n_eye.error + color.bound) && n_eye.error < 1;
  const Projected& projected = site_.scene;
  const auto of_fragment = [&](bool specular) {
    const DoubleMaterial material = material_of(scene_, draw_, {is_back(), specular}, color.value);
    const double of_vertices = follows ? color.bound : 0;  // alpha's, which no light saturates
    const double bound =
        known ? std::max(light_error(scene_, material, {glm::dvec4(p_eye.v, 1), glm::dvec4(0), n_eye.v},
                                     {p_eye.error, n_eye.error, of_vertices, projected.light_errors}, projected.lights),
                         of_vertices)
              : kInfinity;
    return BoundedFour{light(scene_, material, projected.lights, p_eye.v, n_eye.v), bound};
  };
  if (scene_.light_model.separate_specular) secondary = of_fragment(true);
  color = of_fragment(false);
}

BoundedFour FragmentColor::textured(const BoundedFour& color) const {
  const BoundedFour st = attribute([](const Corner& c) { return BoundedFour{glm::dvec4(c.texcoord, 0, 0), 0}; });
  const Texture& texture = scene_.textures.at(draw_.texture->texture);
  const LevelRules rules = level_rules(site_.scene.conventions);
  const BoundedPlace place = place_in_texture(texture, site_, st, rules, site_.slopes_off());
  return bounded_textured_color(texture, *draw_.texture, color, place, rules);
}

Bounded FragmentColor::fog_factor_there() const {
  const Fog& fog = *draw_.fog;
  const Conventions& conventions = site_.scene.conventions;
  const bool is_of_vertices = conventions.fog_factor == Conventions::FogFactor::per_vertex;
  const BoundedFour of_corners = attribute([&](const Corner& c) {
    const Bounded d = fog_distance(site_.scene, c);
    return BoundedFour{glm::dvec4(d.value), d.error};
  });
  Bounded distance{of_corners.value.x, of_corners.bound};
  if (conventions.fog_distance == Conventions::FogDistance::eye_radial && !is_of_vertices) {
    const BoundedFour p = attribute([](const Corner& c) { return BoundedFour{glm::dvec4(c.p_eye, 0), c.p_eye_error}; });
    distance = length_of({glm::dvec3(p.value), kThree * p.bound});
  }
  Bounded out = fog_factor(fog, distance, {16});
  if (is_of_vertices) out = factor_of_vertices(out, std::abs(distance.value));
  out.error = std::isfinite(out.error) ? std::min(1.0, out.error) : 1;
  return out;
}

// Linear fog that is interpolated and then clamped has the factor of the interpolated distance; OpenGL does not say
// which of the two is done first.
Bounded FragmentColor::factor_of_vertices(const Bounded& of_fragment, double distance) const {
  const Fog& fog = *draw_.fog;
  const BoundedFour interpolated = attribute([&](const Corner& c) {
    const Bounded f = fog_factor(fog, fog_distance(site_.scene, c), {16});
    return BoundedFour{glm::dvec4(f.value), f.error};
  });
  FactorRange factors;
  factors.include(std::clamp(interpolated.value.x, 0.0, 1.0));
  if (fog.mode == Fog::Mode::linear || site_.t.cut) factors.include(of_fragment.value);
  if (site_.t.cut) include_factors_of_pieces(factors, fog, site_, distance);
  const double of_ends = factors.most > factors.least ? of_fragment.error : 0;
  return {(factors.least + factors.most) / 2,
          (factors.most - factors.least) / 2 + std::max(interpolated.bound, of_ends)};
}

void FragmentColor::fog(BoundedFour& color) const {
  const Bounded f = fog_factor_there();
  const glm::dvec3 own(color.value), of_fog(draw_.fog->color), from_fog = glm::abs(own - of_fog);
  color.bound += f.error * (std::max({from_fog.x, from_fog.y, from_fog.z}) + color.bound) + 4 * kFloatRounding;
  color.value = glm::dvec4(f.value * own + (1 - f.value) * of_fog, color.value.a);
}

}  // namespace

void set_color(const Scene& scene, const PixelSite& site, PixelHit& hit) {
  const FragmentColor fragment(scene, site, hit.covered_inside);
  const BoundedFour color = fragment.color();
  hit.hit.color = color.value;
  hit.hit.color_bound = color.bound;
  hit.alpha_bound = fragment.has_no_alpha() ? 0 : color.bound + fragment.rounding_of_alpha();
}

void color_hit(const Scene& scene, const Projected& projected, int px, int py, PixelHit& hit) {
  if (hit.colored) return;
  set_color(scene, PixelSite(projected, projected.covering(hit.hit.primitive), px, py), hit);
  hit.colored = true;
}

}  // namespace plumbline::math

// Mistakes in a term of the light equation, at the vertices (stage 2) and per fragment (stage 9).
#include <algorithm>
#include <array>
#include <vector>

#include "faults/lists.h"
#include "faults/variants.h"
#include "kernels/shade.h"
#include "pipeline/geometry.h"

namespace plumbline::faults {

namespace {

using pipeline::EyeLight;
using pipeline::Illumination;
using pipeline::Reflectance;

/// A point that one light shines on.
struct LitPoint {
  EyeLight light;
  Vec3<float> p_eye, n_eye;
  float shininess;
  std::size_t number;          ///< of the light
  float share = 1;             ///< of the light's intensity
  float shine = 1;             ///< of its specular colour
  float wrapped = -1;          ///< share of its diffuse colour wherever the normal points; -1: N.L
  bool shines_behind = false;  ///< its highlight shines where N.L <= 0, too
};

Vec3<float> towards(const LitPoint& at) { return at.light.directional ? at.light.vector : at.light.vector - at.p_eye; }

/// Share of the light's specular colour where N.L <= 0 and its highlight shines there.
float highlight_behind(const LitPoint& at, const LightModel& model) {
  const Vec3<float> vector = towards(at), to_light = pipeline::unit(vector);
  if (!at.shines_behind || pipeline::dot(at.n_eye, to_light) > 0) return 0;
  const Vec3<float> to_eye = model.local_viewer ? pipeline::unit(-at.p_eye) : Vec3<float>{0, 0, 1};
  const float cosine = pipeline::dot(at.n_eye, pipeline::unit(to_light + to_eye));
  if (!(cosine > 0)) return 0;
  return pipeline::reach<float>(at.light, vector, to_light) * pipeline::power(cosine, at.shininess);
}

/// Light equation as a sum over lights; `change` alters each LitPoint.
template <auto change, bool clamps = true>
Color<float> lit_light_by_light(const Illumination& illumination, const Reflectance<float>& reflectance,
                                const Vec3<float>& p_eye, const Vec3<float>& n_eye) {
  Color<float> sum = pipeline::lit<float, float>({illumination.model, {}}, reflectance, p_eye, n_eye);
  for (std::size_t i = 0; i < illumination.lights.size(); ++i) {
    LitPoint point{illumination.lights[i], p_eye, n_eye, reflectance.shininess, i};
    change(point, illumination.model);
    Illumination one{illumination.model, {}};
    one.lights.push_back(point.light);
    Reflectance<float> of_one = reflectance;
    of_one.base = {0, 0, 0};
    const Reflectance<float>::Answer& answer = reflectance.answers[i];
    const bool by_cosine = point.wrapped < 0;
    const Vec3<float> everywhere = by_cosine ? answer.ambient : answer.ambient + point.wrapped * answer.diffuse;
    of_one.answers[0] = {point.share * everywhere, (by_cosine ? point.share : 0.0f) * answer.diffuse,
                         point.share * point.shine * answer.specular};
    const Color<float> added = pipeline::lit<float, float>(one, of_one, point.p_eye, point.n_eye);
    const Vec3<float> behind = highlight_behind(point, illumination.model) * answer.specular;
    sum = {sum.r + added.r + behind.x, sum.g + added.g + behind.y, sum.b + added.b + behind.z, sum.a};
  }
  if (!clamps) return sum;
  return {pipeline::clamp01(sum.r), pipeline::clamp01(sum.g), pipeline::clamp01(sum.b), sum.a};
}

// Lit colours of the part, into the vertices' attribute of that number.
template <auto change, bool clamps>
void light_part(const pipeline::LightInput& of, LitPart part, std::size_t attribute,
                std::span<pipeline::Attributes> out) {
  const bool by_color = of.draw.color_material != ColorMaterial::none && !of.mesh.colors.empty();
  const Illumination in_eye_space = pipeline::illumination(of.scene, of.lights);
  const pipeline::ColoredMaterial material = pipeline::colored_material(of.scene, of.draw, part);
  for (std::size_t i = 0; i < of.vertices.size(); ++i) {
    const Color<float> color = by_color ? Color<float>(of.mesh.colors[i]) : Color<float>{};
    const Reflectance<float> of_vertex =
        pipeline::reflectance<float>(of.scene, by_color ? material : pipeline::ColoredMaterial{material.own}, color);
    const Vec3<float>& n = of.vertices[i].n_eye;
    const Color<float> lit =
        lit_light_by_light<change, clamps>(in_eye_space, of_vertex, of.vertices[i].p_eye, part.back ? -n : n);
    out[i][attribute] = {lit.r, lit.g, lit.b, part.secondary ? 0 : lit.a};
  }
}

template <auto change, bool clamps = true>
void at_vertices(const pipeline::LightInput& in, std::vector<pipeline::Attributes>& out) {
  pipeline::light(in, out);
  if (!is_lit_per_vertex(in.draw)) return;
  const std::span<pipeline::Attributes> added = std::span(out).last(in.vertices.size());
  light_part<change, clamps>(in, {}, 0, added);
  for (const Varying v : kAllVaryings) {
    if (!is_lit(v) || !carries(in.scene, in.draw, v)) continue;
    light_part<change, clamps>(in, {is_back(v), is_secondary(v)}, 1 + index_of(v), added);
  }
}

template <auto change>
Color<float> lit_fragment(const pipeline::FragmentLight& light, LitPart part,
                          const pipeline::SurfaceAttributes<float>& a) {
  const Vec3<float> p_eye(a[Varying::position]), normal(a[Varying::normal]);
  const float size = pipeline::length(normal);
  const Reflectance<float> of =
      light.by_color ? pipeline::reflectance<float>(*light.scene, light.material[part.back][part.secondary], a.color)
                     : light.reflectance[part.back][part.secondary];
  return lit_light_by_light<change>(light.illumination, of, p_eye, normal / (part.back ? -size : size));
}

// Shade of an unlit surface in lit colours.
template <auto change>
pipeline::Shaded at_fragments(const pipeline::Surface& surface, bool front,
                              const pipeline::SurfaceAttributes<float>& a) {
  if (!surface.light) return {pipeline::shade<float>(surface, front, a)};
  const bool back = !front && surface.scene->light_model.sides == LightModel::Sides::two;
  pipeline::SurfaceAttributes<float> lit = a;
  lit.color = lit_fragment<change>(*surface.light, {back, false}, a);
  lit[Varying::secondary] = lit_fragment<change>(*surface.light, {back, true}, a);
  pipeline::Surface unlit = surface;
  unlit.light.reset();
  return {pipeline::shade<float>(unlit, front, lit)};
}

constexpr auto kAbsoluteCosine = [](LitPoint& at, const LightModel&) {
  if (pipeline::dot(at.n_eye, towards(at)) < 0) at.n_eye = -at.n_eye;
};

// Unnormalised vector to a point light; the light's reach and cone stay right.
constexpr auto kLongVector = [](LitPoint& at, const LightModel&) {
  if (at.light.directional) return;
  const Vec3<float> vector = towards(at);
  at.share = pipeline::reach<float>(at.light, vector, pipeline::unit(vector));
  at.light.vector = vector;
  at.light.directional = true;
  at.light.attenuates = at.light.has_cone = false;
  at.light.half = pipeline::unit(at.light.vector + Vec3<float>{0, 0, 1});
};

// The point mirrored at the eye, and its light moved along: same direction to the light, opposite one to the eye.
constexpr auto kFromTheEye = [](LitPoint& at, const LightModel& model) {
  if (!model.local_viewer) {
    if (at.light.directional) at.light.half = pipeline::unit(at.light.vector - Vec3<float>{0, 0, 1});
    return;
  }
  if (!at.light.directional) at.light.vector = at.light.vector - at.p_eye - at.p_eye;
  at.p_eye = -at.p_eye;
};

constexpr auto kLongHalfVector = [](LitPoint& at, const LightModel& model) {
  const Vec3<float> to_eye = model.local_viewer ? pipeline::unit(-at.p_eye) : Vec3<float>{0, 0, 1};
  at.shine = pipeline::power(pipeline::length(pipeline::unit(towards(at)) + to_eye), at.shininess);
};

constexpr auto kDirectionReversed = [](LitPoint& at, const LightModel&) {
  if (!at.light.directional) return;
  at.light.vector = -at.light.vector;
  at.light.half = pipeline::unit(at.light.vector + Vec3<float>{0, 0, 1});
};

constexpr auto kDirectionAsPoint = [](LitPoint& at, const LightModel&) { at.light.directional = false; };

constexpr auto kFirstLightAlone = [](LitPoint& at, const LightModel&) { at.share = at.number == 0 ? 1 : 0; };

constexpr auto kNoSquare = [](LitPoint& at, const LightModel&) { at.light.attenuation.z = 0; };

constexpr auto kConeWithoutExponent = [](LitPoint& at, const LightModel&) { at.light.exponent = 0; };

constexpr auto kShineByCosine = [](LitPoint& at, const LightModel&) {
  at.shine = std::max(pipeline::dot(at.n_eye, pipeline::unit(towards(at))), 0.0f);
};

// Diffuse share (N.L + 1) / 2, also for N.L < 0.
constexpr auto kHalfLambert = [](LitPoint& at, const LightModel&) {
  at.wrapped = 0.5f * pipeline::dot(at.n_eye, pipeline::unit(towards(at))) + 0.5f;
};

constexpr auto kSpecularFromBehind = [](LitPoint& at, const LightModel& model) {
  at.shines_behind = model.specular == LightModel::Specular::half_vector;
};

constexpr auto kNoChange = [](LitPoint&, const LightModel&) {};

template <auto change>
constexpr Fault term_at_vertices(std::string_view name, std::string_view what) {
  return stage_fault(name, what, put<&Stages::light, at_vertices<change>>);
}
template <auto change>
constexpr Fault term_per_fragment(std::string_view name, std::string_view what) {
  return stage_fault(name, what, put<&Stages::shade, at_fragments<change>>);
}

constexpr std::array kTerms = {
    term_at_vertices<kAbsoluteCosine>("light.n_l_absolute", "|N.L| for max(N.L, 0): surfaces are lit from behind"),
    term_at_vertices<kLongVector>("light.l_not_normalised",
                                  "the vector to a point light is not brought to unit length"),
    term_at_vertices<kFromTheEye>("light.view_reversed", "highlights are by the vector from the eye, not to it"),
    term_at_vertices<kLongHalfVector>("light.half_vector_not_normalised",
                                      "the half vector, L + V, is not brought to unit length"),
    term_at_vertices<kDirectionReversed>("light.direction_reversed",
                                         "a directional light shines from the side that it shines to"),
    term_at_vertices<kDirectionAsPoint>("light.direction_as_point",
                                        "a directional light is a point light at its direction's numbers"),
    term_at_vertices<kFirstLightAlone>("light.first_light_alone", "lights but the first are left out"),
    term_at_vertices<kNoSquare>("light.no_square_of_distance", "attenuation lacks its term of the distance's square"),
    term_at_vertices<kConeWithoutExponent>("light.no_spot_exponent",
                                           "spot lights are as bright at their cone's border"),
    term_at_vertices<kShineByCosine>("light.highlight_by_n_l", "highlights are multiplied by N.L"),
    term_at_vertices<kHalfLambert>("light.half_lambert", "diffuse light is by (N.L + 1) / 2, which no side is without"),
    term_at_vertices<kSpecularFromBehind>("light.specular_from_behind", "highlights shine where N.L <= 0"),
    stage_fault("light.not_clamped", "lit colours beyond 1 are interpolated, and clamped at the fragments",
                put<&Stages::light, at_vertices<kNoChange, false>>),
    term_per_fragment<kAbsoluteCosine>("shade.n_l_absolute",
                                       "light per fragment: |N.L| for max(N.L, 0): surfaces are lit from behind"),
    term_per_fragment<kLongVector>("shade.l_not_normalised",
                                   "light per fragment: the vector to a point light is not brought to unit length"),
    term_per_fragment<kFromTheEye>("shade.view_reversed",
                                   "light per fragment: highlights are by the vector from the eye, not to it"),
    term_per_fragment<kLongHalfVector>("shade.half_vector_not_normalised",
                                       "light per fragment: the half vector, L + V, is not brought to unit length"),
    term_per_fragment<kDirectionReversed>(
        "shade.direction_reversed", "light per fragment: a directional light shines from the side that it shines to"),
    term_per_fragment<kDirectionAsPoint>(
        "shade.direction_as_point",
        "light per fragment: a directional light is a point light at its direction's numbers"),
    term_per_fragment<kFirstLightAlone>("shade.first_light_alone",
                                        "light per fragment: lights but the first are left out"),
    term_per_fragment<kNoSquare>("shade.no_square_of_distance",
                                 "light per fragment: attenuation lacks its term of the distance's square"),
    term_per_fragment<kConeWithoutExponent>("shade.no_spot_exponent",
                                            "light per fragment: spot lights are as bright at their cone's border"),
    term_per_fragment<kShineByCosine>("shade.highlight_by_n_l", "light per fragment: highlights are multiplied by N.L"),
    term_per_fragment<kSpecularFromBehind>("shade.specular_from_behind",
                                           "light per fragment: highlights shine where N.L <= 0"),
    term_per_fragment<kHalfLambert>("shade.half_lambert",
                                    "light per fragment: diffuse light is by (N.L + 1) / 2, which no side is without"),
};

}  // namespace

std::span<const Fault> of_light_terms() { return kTerms; }

}  // namespace plumbline::faults

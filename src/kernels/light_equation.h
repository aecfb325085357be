// Light equation at one point: OpenGL's (2.1 spec, section 2.14.1) or note 000's, as the scene's light model has it.
#pragma once

#include <array>
#include <limits>
#include <span>

#include "capture/stages.h"
#include "kernels/attributes.h"
#include "kernels/math.h"
#include "scene/fixed_vector.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Lights of the scene in eye space, as stage 0 hands them on, in the scene's order.
using Lights = std::span<const LightSource<float>>;

/// A light in eye space, ready for the equation.
struct EyeLight {
  bool directional;
  Vec3<float> vector;  ///< unit direction towards a directional light; position of a point light
  Vec3<float> half;    ///< directional: unit vector half way between `vector` and a viewer infinitely far along +z
  bool attenuates, has_cone;
  Vec3<float> attenuation;  ///< k0, k1, k2
  Vec3<float> cone;         ///< unit direction in which a spot light shines
  float cos_cutoff, exponent;
};

/// Light model and lights of a scene.
struct Illumination {
  LightModel model;
  FixedVector<EyeLight, 8> lights;
};
/// Light model of the scene, and its lights ready for the equation. `lights`: stage 0's, one per light of the scene.
Illumination illumination(const Scene& scene, Lights lights);

/// A material, and which of its colours the vertex colour replaces (lit_material(), scene.h).
struct ColoredMaterial {
  Material own;
  bool emission = false, ambient = false, diffuse = false, specular = false;
};
ColoredMaterial colored_material(const Scene& scene, const Draw& draw, LitPart part);

/// Products of a material's colours and the lights' colours.
template <class R>
struct Reflectance {
  struct Answer {
    Vec3<R> ambient, diffuse, specular;
  };
  Vec3<R> base;                   ///< emission, and ambient times the light model's ambient
  std::array<Answer, 8> answers;  ///< per light, in the scene's order
  float shininess;
  R alpha;
};
/// `color`: the vertex colour; read only for the parts that `material` marks as replaced.
template <class R>
Reflectance<R> reflectance(const Scene& scene, const ColoredMaterial& material, const Color<R>& color) {
  const Material& own = material.own;
  const auto of = [&](bool of_color, const glm::vec4& v) { return of_color ? Vec3<R>(color) : Vec3<R>(v); };
  const Vec3<R> ambient = of(material.ambient, own.ambient), diffuse = of(material.diffuse, own.diffuse);
  const Vec3<R> specular = of(material.specular, own.specular);
  Reflectance<R> out;
  out.base = of(material.emission, own.emission) + ambient * Vec3<R>(scene.light_model.ambient);
  out.shininess = own.shininess;
  out.alpha = material.diffuse ? color.a : R(own.diffuse.a);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Light& l = scene.lights[i];
    out.answers[i] = {Vec3<R>(l.ambient) * ambient, Vec3<R>(l.diffuse) * diffuse, Vec3<R>(l.specular) * specular};
  }
  return out;
}

/// diffuse: max(N.L, 0), and 0 where Sides::flip excludes the light. specular: max(N.H, 0) or max(R.E, 0), the base of
/// the shininess power, which counts only where diffuse is above 0.
template <class R>
struct Cosines {
  R diffuse, specular;
};

template <class R>
R positive_dot(const Vec3<R>& a, const Vec3<R>& b) {
  return greater_of(dot(a, b), R(0));
}

template <class R>
Cosines<R> cosines(const LightModel& model, const EyeLight& light, Vec3<R> n, const Vec3<R>& to_light,
                   const Vec3<R>& to_eye) {
  Mask<R> seen = n.x == n.x;
  if (model.sides == LightModel::Sides::flip) {
    const R n_dot_l = dot(n, to_light), n_dot_e = dot(n, to_eye);
    const Mask<R> from_behind = (n_dot_l < R(0)) & (n_dot_e < R(0));
    seen = from_behind | (n_dot_e > R(0));
    n = select<R>(from_behind, -n, n);
  }
  const R diffuse = select(seen, positive_dot(n, to_light), R(0));
  if (model.specular == LightModel::Specular::half_vector) {
    const bool fixed = light.directional && !model.local_viewer;
    return {diffuse, positive_dot(n, fixed ? Vec3<R>(light.half) : unit(to_light + to_eye))};
  }
  const Vec3<R> mirrored = (R(2) * diffuse) * n - to_light;
  return {diffuse, positive_dot(mirrored, to_eye)};
}

/// Factor of a point light's attenuation and cone; 0 outside the cone. `from_point`: vector from the point to the
/// light; `to_light`: unit vector of that direction.
template <class R>
R reach(const EyeLight& light, const Vec3<R>& from_point, const Vec3<R>& to_light) {
  R share(1);
  if (light.attenuates) {
    const R d = length(from_point);
    const Vec3<float>& k = light.attenuation;
    // The sum is 0 only at the light itself, where k0 is 0.
    share = R(1) / greater_of(R(std::numeric_limits<float>::min()), k.x + (k.y + k.z * d) * d);
  }
  if (light.has_cone) {
    const R cosine = -dot(to_light, Vec3<R>(light.cone));
    share = select(cosine >= R(light.cos_cutoff), share * power(cosine, light.exponent), R(0));
  }
  return share;
}

/// Lit colour of a point: rgba clamped to [0,1], alpha the diffuse material's. Where the normal faces away from a
/// light, the light's diffuse and specular terms are 0; outside its cone, so is its ambient term. `n_eye` may have any
/// length, and is not normalised. `T`: float where all lanes have one material, else R.
template <class R, class T>
Color<R> lit(const Illumination& illumination, const Reflectance<T>& reflectance, const Vec3<R>& p_eye,
             const Vec3<R>& n_eye) {
  const Vec3<R> to_eye = illumination.model.local_viewer ? unit(-p_eye) : Vec3<R>{R(0), R(0), R(1)};
  Vec3<R> sum = Vec3<R>(reflectance.base);
  for (std::size_t i = 0; i < illumination.lights.size(); ++i) {
    const EyeLight& light = illumination.lights[i];
    const typename Reflectance<T>::Answer& answer = reflectance.answers[i];
    const Vec3<R> place = Vec3<R>(light.vector), from_point = light.directional ? place : place - p_eye;
    const Vec3<R> to_light = light.directional ? place : unit(from_point);
    Vec3<R> color = Vec3<R>(answer.ambient);
    const Cosines<R> c = cosines<R>(illumination.model, light, n_eye, to_light, to_eye);
    const Mask<R> faces = c.diffuse > R(0);
    if (any(faces)) {
      Vec3<R> bright = color + c.diffuse * Vec3<R>(answer.diffuse);
      const Vec3<T>& s = answer.specular;
      if (any((s.x != T(0)) | (s.y != T(0)) | (s.z != T(0)))) {
        bright = bright + power(c.specular, reflectance.shininess) * Vec3<R>(s);
      }
      color = select<R>(faces, bright, color);
    }
    if (!light.attenuates && !light.has_cone) {
      sum = sum + color;
      continue;
    }
    const R share = reach(light, from_point, to_light);
    sum = select<R>(share > R(0), sum + share * color, sum);
  }
  return {clamp01(sum.x), clamp01(sum.y), clamp01(sum.z), clamp01(R(reflectance.alpha))};
}

// Light per fragment (Phong, Illumination for computer generated pictures, CACM 1975).

/// Per-draw input of the light equation at fragments. `scene` must outlive it.
struct FragmentLight {
  const Scene* scene;
  bool by_color;  ///< the mesh's colours replace parts of the material
  Illumination illumination;
  ColoredMaterial material[2][2];        ///< [LitPart::back][LitPart::secondary]
  Reflectance<float> reflectance[2][2];  ///< of material[][].own
};
/// Input of the light equation at the draw's fragments. `lights`: stage 0's.
FragmentLight fragment_light(const Scene& scene, const Draw& draw, Lights lights);

/// Light equation at a fragment. `n`: the interpolated normal, brought to unit length here, and turned over for a back
/// part; `p`: the interpolated p_eye; `color`: the interpolated vertex colour.
template <class R>
Color<R> lit_fragment(const FragmentLight& light, LitPart part, const Color<R>& color, const Color<R>& n,
                      const Color<R>& p) {
  const Vec3<R> p_eye(p), normal(n);
  const R size = length(normal);
  const Vec3<R> n_eye = normal / (part.back ? -size : size);
  if (!light.by_color) return lit(light.illumination, light.reflectance[part.back][part.secondary], p_eye, n_eye);
  const ColoredMaterial& material = light.material[part.back][part.secondary];
  return lit(light.illumination, reflectance(*light.scene, material, color), p_eye, n_eye);
}

}  // namespace plumbline::pipeline

// The light equation at one point (OpenGL 2.1 spec, section 2.14.1), and note 000's in its place.
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

/// The scene's lights, as stage 0 hands them on.
using Lights = std::span<const LightSource<float>>;

/// A light in eye space, ready for the equation.
struct EyeLight {
  bool directional;
  Vec3<float> vector;  ///< unit direction towards it, or its place
  Vec3<float> half;    ///< of a directional light, unit, half way to a viewer infinitely far away
  bool attenuates, has_cone;
  Vec3<float> attenuation;  ///< k0, k1, k2
  Vec3<float> cone;         ///< unit direction to which it shines
  float cos_cutoff, exponent;
};

/// Light model and lights: the same for all of a scene.
struct Illumination {
  LightModel model;
  FixedVector<EyeLight, 8> lights;
};
/// `lights`: one for each of the scene's.
Illumination illumination(const Scene& scene, Lights lights);

/// A material, and what of it a colour stands for (lit_material(), scene.h).
struct ColoredMaterial {
  Material own;
  bool emission = false, ambient = false, diffuse = false, specular = false;
};
ColoredMaterial colored_material(const Scene& scene, const Draw& draw, LitPart part);

/// A material's colours times the lights': emission and ambient light, and each light's three.
template <class R>
struct Reflectance {
  struct Answer {
    Vec3<R> ambient, diffuse, specular;
  };
  Vec3<R> base;
  std::array<Answer, 8> answers;  ///< beside the lights
  float shininess;
  R alpha;
};
/// `color`: the vertex colour, in place of those parts of the material that `material` says it stands for.
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
/// the shininess power; it counts only where diffuse is above 0.
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

/// Share of a light that distance and cone leave.
template <class R>
R reach(const EyeLight& light, const Vec3<R>& from_point, const Vec3<R>& to_light) {
  R share(1);
  if (light.attenuates) {
    const R d = length(from_point);
    const Vec3<float>& k = light.attenuation;
    // Only a light at the point itself has nothing to divide by.
    share = R(1) / greater_of(R(std::numeric_limits<float>::min()), k.x + (k.y + k.z * d) * d);
  }
  if (light.has_cone) {
    const R cosine = -dot(to_light, Vec3<R>(light.cone));
    share = select(cosine >= R(light.cos_cutoff), share * power(cosine, light.exponent), R(0));
  }
  return share;
}

/// rgba, clamped to [0,1]; alpha is the diffuse material's. Where a normal faces away from a light, its diffuse and
/// specular terms are 0; outside a light's cone, its ambient one too. `n_eye` need not be of unit length.
/// `T`: float where all lanes are of one material, or R.
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

/// Per-draw input of the light equation at fragments.
struct FragmentLight {
  const Scene* scene;
  bool by_color;  ///< its colours stand for some of its material
  Illumination illumination;
  // Front or back, without and of the specular part:
  ColoredMaterial material[2][2];
  Reflectance<float> reflectance[2][2];  ///< of its own material
};
/// `lights`: stage 0's.
FragmentLight fragment_light(const Scene& scene, const Draw& draw, Lights lights);

/// The light equation at a point of a face, the normal brought to unit length. `color`: the interpolated vertex colour.
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

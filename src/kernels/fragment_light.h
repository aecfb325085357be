// Light per fragment (Phong, Illumination for computer generated pictures, CACM 1975).
#pragma once

#include "kernels/attributes.h"
#include "kernels/light_equation.h"

namespace plumbline::pipeline {

/// What a draw's fragments are lit by.
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
  const Vector<R> p_eye{p.r, p.g, p.b}, normal{n.r, n.g, n.b};
  const R length = square_root(dot(normal, normal));
  const Vector<R> n_eye = normal / (part.back ? -length : length);
  if (!light.by_color) return lit(light.illumination, light.reflectance[part.back][part.secondary], p_eye, n_eye);
  const ColoredMaterial& material = light.material[part.back][part.secondary];
  return lit(light.illumination, reflectance(*light.scene, material, color), p_eye, n_eye);
}

}  // namespace plumbline::pipeline

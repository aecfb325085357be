// Light per fragment (Phong, Illumination for computer generated pictures, CACM 1975).
#pragma once

#include "pipeline/attributes.h"
#include "pipeline/light_equation.h"

namespace plumbline::pipeline {

/// What a draw's fragments are lit by.
struct FragmentLight {
  const Scene* scene;
  const Draw* draw;
  bool by_color;  ///< its colours stand for some of its material
  Illumination illumination;
  Reflectance reflectance[2][2];  ///< of its own material: front or back, without and of the specular part
};
FragmentLight fragment_light(const Scene& scene, const Draw& draw);

/// The light equation at a point of a face, the normal brought to unit length. `color`: the interpolated vertex colour.
Vec4<float> lit_fragment(const FragmentLight& light, LitPart part, const Vec4<float>& color, const Vec3<float>& n_eye,
                         const Vec3<float>& p_eye);

/// The same of a fragment's attributes.
inline Color<float> lit_fragment(const FragmentLight& light, LitPart part, const Color<float>& color,
                                 const Color<float>& n, const Color<float>& p) {
  const Vec4<float> out = lit_fragment(light, part, Vec4<float>(color.r, color.g, color.b, color.a),
                                       Vec3<float>(n.r, n.g, n.b), Vec3<float>(p.r, p.g, p.b));
  return {out.r, out.g, out.b, out.a};
}

}  // namespace plumbline::pipeline

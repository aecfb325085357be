// Stage 9: the fragment's colour, from its attributes.
#pragma once

#include "kernels/environment.h"
#include "kernels/fog.h"
#include "kernels/surface.h"

namespace plumbline::pipeline {

/// rgb of the two added up and clamped (OpenGL 2.1 spec 3.9).
template <class R>
Color<R> color_sum(const Color<R>& primary, const Color<R>& secondary) {
  const auto sum = [](R a, R b) { return clamp01(a + b); };
  return {sum(primary.r, secondary.r), sum(primary.g, secondary.g), sum(primary.b, secondary.b), primary.a};
}

/// In OpenGL's order (2.1, figure 3.1): light, where it is per fragment, texture environment, sum of colours, fog.
/// `front`: the face, where light has two sides.
template <class R>
Color<R> shade(const Surface& surface, bool front, const SurfaceAttributes<R>& attributes) {
  const LightModel& model = surface.scene->light_model;
  const auto lit_part = [&](bool specular) {
    const bool back = !front && model.sides == LightModel::Sides::two;
    return lit_fragment(*surface.light, {back, specular}, attributes.color, attributes[Varying::normal],
                        attributes[Varying::position]);
  };
  Color<R> color = surface.light ? lit_part(false) : attributes.color;
  if (surface.texture) {
    color =
        apply_environment<R>(surface.texture->texture->format, *surface.draw->texture, color, attributes.texel.color);
  }
  if (surface.draw->lit && model.separate_specular) {
    color = color_sum<R>(color, surface.light ? lit_part(true) : attributes[Varying::secondary]);
  }
  if (surface.draw->fog) color = fogged<R>(*surface.draw->fog, color, attributes[Varying::position].b);
  return color;
}

}  // namespace plumbline::pipeline

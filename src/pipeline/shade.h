// Stage 9: the fragment's colour, from its attributes.
#pragma once

#include "pipeline/environment.h"
#include "pipeline/fog.h"
#include "pipeline/surface.h"

namespace plumbline::pipeline {

/// The interpolated vertex colour.
template <class R>
Color<R> shade(const Color<R>& attributes) {
  return attributes;
}

/// In OpenGL's order (2.1, figure 3.1): light, where it is per fragment, texture environment, sum of colours, fog.
template <class R>
Color<R> shade_surface(const Surface& surface, bool /*front*/, const SurfaceAttributes<R>& attributes) {
  Color<R> color = attributes.color;
  if (surface.light) {
    color = lit_fragment(*surface.light, color, attributes[Varying::normal], attributes[Varying::position]);
  }
  if (surface.texture) {
    color =
        apply_environment<R>(surface.texture->texture->format, *surface.draw->texture, color, attributes.texel.color);
  }
  if (surface.draw->fog) color = fogged<R>(*surface.draw->fog, color, attributes[Varying::position].b);
  return color;
}

}  // namespace plumbline::pipeline

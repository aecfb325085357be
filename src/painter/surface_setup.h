// Stages 7 and 8 of fragments that a surface colours.
#pragma once

#include <array>

#include "kernels/shade.h"
#include "kernels/surface.h"

namespace plumbline::pipeline {

/// Per-triangle input of stages 6 and 7 in one tile.
struct FragmentSetup {
  bool front;
  Anchor anchor;
  DepthPlane depth_plane;
  PerspectiveSetup perspective;
  AttributeSetup attributes;  ///< the colour's
};
/// A triangle's varyings, those that the surface carries.
struct SurfaceSetup {
  const Surface* surface;
  std::array<AttributeSetup, kVaryings> varyings;
  GradientSetup gradients;  ///< of the texture coordinates, where there is a texture
};

/// Colour, every varying by the same weights, and the texel.
template <class R>
[[gnu::always_inline]] inline SurfaceAttributes<R> surface_attributes(const FragmentSetup& of, const SurfaceSetup& s,
                                                                      const Pixels<R>& p) {
  SurfaceAttributes<R> out;
  const Offset<R> at = from_anchor<R>(of.anchor, p);
  const Weights<R> k = weights<R>(of.perspective, at);
  out.color = mean<R>(of.attributes, k);
  for (const Varying v : s.surface->carried) {
    out[v] = mean<R>(s.varyings[static_cast<std::size_t>(v)], k);
  }
  if (s.surface->texture) {
    const Color<R>& st = out[Varying::texture];
    const Gradients<R> g = gradients<R>(s.gradients, at, value_at<R>(of.perspective.sum, at));
    out.texel.color = texel_color<R>(*s.surface->texture, {st.r, st.g}, g);
  }
  return out;
}

}  // namespace plumbline::pipeline

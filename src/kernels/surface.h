// What a draw's fragments are coloured by: texture, light per fragment, and the varyings that these read.
#pragma once

#include <array>
#include <optional>

#include "base/fixed_vector.h"
#include "capture/stages.h"
#include "kernels/attributes.h"
#include "kernels/light_equation.h"
#include "kernels/texture.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// A draw's state of stages 7 to 9. Pointers into the scene.
struct Surface {
  const Scene* scene = nullptr;
  const Draw* draw = nullptr;
  std::optional<FragmentLight> light;       ///< none: lit at the vertices, or not at all
  FixedVector<Varying, kVaryings> carried;  ///< by the draw's fragments
  std::optional<TextureSetup> texture;
  const void* program = nullptr;  ///< a user's fragment program (program.h)
};
/// `lights`: stage 0's.
inline Surface surface_of(const Scene& scene, const Draw& draw, Lights lights) {
  Surface surface{&scene, &draw, {}, {}, {}};
  if (draw.texture) {
    const Texture& texture = scene.textures.at(draw.texture->texture);
    surface.texture = texture_setup(texture, texture.sampler);
  }
  if (is_lit_per_fragment(draw)) surface.light = fragment_light(scene, draw, lights);
  for (const Varying v : kAllVaryings) {
    if (!is_back(v) && carries(scene, draw, v)) surface.carried.push_back(v);
  }
  return surface;
}

/// A fragment's attributes, zero where the surface does not carry one; and its texel, where there is a texture.
template <class R>
struct SurfaceAttributes {
  Color<R> color;
  std::array<Color<R>, kVaryings> varyings;
  FilteredTexel<R> texel;
  const Color<R>& operator[](Varying v) const { return varyings[static_cast<std::size_t>(v)]; }
  Color<R>& operator[](Varying v) { return varyings[static_cast<std::size_t>(v)]; }
};

}  // namespace plumbline::pipeline

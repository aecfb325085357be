// What a draw's fragments are coloured by where the interpolated colour is not all.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/fixed_vector.h"
#include "capture/stages.h"
#include "pipeline/attributes.h"
#include "pipeline/fragment_light.h"
#include "pipeline/texture.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// A draw's, ready to be asked per fragment.
struct Surface {
  const Scene* scene = nullptr;
  const Draw* draw = nullptr;          ///< null: plain, nothing of this is asked
  std::optional<FragmentLight> light;  ///< none: lit at the vertices, or not at all
  FixedVector<Varying, kVaryings> carried;
  std::array<std::span<const std::array<Vec4<float>, 3>>, kVaryings> columns;  ///< of the scene's window triangles

  std::optional<TextureSetup> texture;

  bool plain() const { return draw == nullptr; }
};
/// A draw's. Spans into the records, pointers into the scene. Lit by the records' lights; where these have none, by the
/// scene's.
Surface surface_of(const Scene& scene, const Draw& draw, const Records<float>& records);
/// One per draw.
std::vector<Surface> surfaces_of(const Scene& scene, const Records<float>& records);

/// A triangle's carried varyings.
struct SurfaceSetup {
  const Surface* surface;
  bool front;
  std::array<AttributeSetup, kVaryings> varyings;
  GradientSetup gradients;  ///< of the texture coordinates, where there is a texture
};

/// A fragment's attributes: those that the surface carries; and its texel, where it has a texture.
template <class R>
struct SurfaceAttributes {
  Color<R> color;
  std::array<Color<R>, kVaryings> varyings;
  FilteredTexel<R> texel;
  const Color<R>& operator[](Varying v) const { return varyings[static_cast<std::size_t>(v)]; }
  Color<R>& operator[](Varying v) { return varyings[static_cast<std::size_t>(v)]; }
};

/// The triangle with a varying in the place of its colour.
inline WindowTriangle<float> with_varying(WindowTriangle<float> triangle, const std::array<Vec4<float>, 3>& corners) {
  for (auto corner = corners.begin(); auto& v : triangle.v) v.color = *corner++;
  return triangle;
}

}  // namespace plumbline::pipeline

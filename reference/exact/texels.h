// Stage 8: a fragment's LOD and filtered texel, in double (filters: reference/arithmetic/texture.h).
#pragma once

#include <vector>

#include "capture/capture.h"
#include "reference/arithmetic/texture.h"
#include "reference/exact/barycentric.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Triangle with its texture. All members are references; the objects must outlive this one.
struct TexturedTriangle {
  const WindowTriangle<double>& triangle;
  const std::array<glm::dvec4, 3>& texcoords;  ///< s and t at the corners
  const Texture& texture;
  const Barycentric& weights;
};

/// Derivatives of (s, t) by window x and y [1 / pixel] at a pixel's centre, by the quotient rule from s/w, t/w and 1/w.
struct TextureGradient {
  glm::dvec2 d_dx, d_dy;
};
TextureGradient texture_gradient(const TexturedTriangle& t, int x, int y);

/// LOD and texel at pixel (x, y)'s centre, where the texture coordinates are `st`.
Texel<double> texel_at(const TexturedTriangle& t, glm::dvec2 st, int x, int y, const math::LevelRules& rules = {});

/// Stage 8, from records.triangles, covered and varyings. Sets out.records.texels: the LOD from the triangles, the
/// colour at the recorded texture coordinates and, where texels are recorded, at their recorded LOD. Sets
/// out.legal.texels: the range over the LODs that the conventions allow at the four pixels of the fragment's 2 x 2
/// quad. Sets nothing if no draw has a texture. Throws std::invalid_argument where the records do not fit the scene or
/// each other.
void filter_texels(const Scene& scene, const Records<double>& records, const Conventions& conventions, Capture& out);

}  // namespace plumbline::exact

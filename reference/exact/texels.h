// Stage 8: a fragment's texel, on real numbers (reference/arithmetic/texture.h filters).
#pragma once

#include <vector>

#include "capture/capture.h"
#include "reference/exact/barycentric.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// A triangle with a texture: its coordinates at the corners.
struct TexturedTriangle {
  const WindowTriangle<double>& triangle;
  const std::array<glm::dvec4, 3>& texcoords;
  const Texture& texture;
  const Barycentric& weights;
};

/// Derivatives of (s, t) by window x and y at a pixel's centre: the quotient rule, from s/w, t/w and 1/w.
struct TextureGradient {
  glm::dvec2 d_dx, d_dy;
};
TextureGradient texture_gradient(const TexturedTriangle& t, int x, int y);

/// At pixel (x, y)'s centre, where the texture coordinates are `st`.
Texel<double> texel_at(const TexturedTriangle& t, glm::dvec2 st, int x, int y);

/// Stage 8 of records.triangles, covered and varyings: out.records.texels, the level of detail from the triangles, the
/// colour at the records' own texture coordinates and, where there are texels, at their own level of detail; and
/// out.legal.texels, over the levels of detail at the four pixels of (x, y)'s square of two by two. Nothing without a
/// texture. Throws std::invalid_argument where the records do not fit the scene or each other.
void filter_texels(const Scene& scene, const Records<double>& records, Capture& out);

}  // namespace plumbline::exact

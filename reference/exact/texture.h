// Stage 8: texture filtering, from OpenGL 2.1's equations (3.8.7 to 3.8.9), on real numbers; and stage 9's environment.
#pragma once

#include <array>

#include "reference/exact/barycentric.h"
#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::exact {

/// Texture coordinates and their derivatives by window x and y, at a pixel's centre.
struct TexturePlace {
  glm::dvec2 st, d_dx, d_dy;
};
/// `texcoords`: the corners'. By the quotient rule from the planes of s/w, t/w and 1/w.
TexturePlace texture_place(const WindowTriangle<double>& triangle, const std::array<glm::dvec2, 3>& texcoords,
                           const Barycentric& weights, int x, int y);

/// lambda, with the texture's bias and limits (equations 3.17 to 3.22).
double level_of_detail(const Texture& texture, const TexturePlace& place);

/// The texture source components at (s, t), filtered at lambda.
glm::dvec4 filtered_texel(const Texture& texture, glm::dvec2 st, double lambda);

/// The fragment's colour and the texel's as one (tables 3.22 and 3.23). Sums are clamped to [0,1].
glm::dvec4 textured_color(TextureFormat format, const DrawTexture& state, const glm::dvec4& fragment,
                          const glm::dvec4& texel);

}  // namespace plumbline::exact

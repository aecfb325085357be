// Textures: how far a texel may be off, and what that comes to in the fragment's colour.
#pragma once

#include <string_view>

#include "scene/scene.h"
#include "stages/legal.h"
#include "stages/stages.h"

namespace plumbline::check {

/// The texture's largest component, at least 1: what float arithmetic on its texels is proportional to.
double largest_texel(const Texture& texture);

/// How far from the range of legal texels another renderer's may be.
struct TexelBound {
  TexelRange range;
  Vec4<double> slack{0};  ///< by its texture coordinates' errors and its own arithmetic; infinite: it is open
  double open_share = 0;  ///< how probable it is that it is open, for a place that knows nothing of texels
};
/// `st_error`: of its texture coordinates (s, t); 4 u of them more for its texel coordinates, and `factor` u of the
/// texture's largest component. Within st_error of where another texel is the nearest, it is open.
TexelBound texel_bound(const Texture& texture, const TexelRange& range, Vec2<double> st, Vec2<double> st_error,
                       double factor);

/// Why another texel than the legal ones is Mesa's fault, where the texture is between magnified and minified: linear
/// magnification gives way to the nearest texels of mipmaps at a lambda of 1/2 (OpenGL 2.1 spec 3.8.9, c), and theirs
/// at 0. Empty elsewhere. `lod`: the candidate's; its four pixels' may be half a level off.
std::string_view switched_early(const Texture& texture, double lod);

/// The colour that fragment colour `f` and texel `s` become, and its error, where theirs are f_error and s_error:
/// |d/df| f_error + |d/ds| s_error + their product, and `roundings` u of the terms (OpenGL 2.1 spec,
/// tables 3.22, 3.23).
struct Environed {
  Vec4<double> color, error;
};
Environed environ_error(TextureFormat format, const DrawTexture& state, const Vec4<double>& f,
                        const Vec4<double>& f_error, const Vec4<double>& s, const Vec4<double>& s_error,
                        double roundings);

}  // namespace plumbline::check

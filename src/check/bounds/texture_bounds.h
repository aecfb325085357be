// Error bounds of texels, and of the colours that a texture environment makes of them.
#pragma once

#include <string_view>

#include "capture/legal.h"
#include "capture/stages.h"
#include "check/bounds/bounds.h"
#include "check/bounds/mean_bounds.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Largest |component| of level 0, at least 1; other levels are means of it. Float errors of texels scale with it.
double largest_texel(const Texture& texture);

/// Range of legal texels, and the slack by which another renderer's texel may leave it.
struct TexelBound {
  TexelRange range;
  Vec4<double> slack{0};  ///< from errors of the texture coordinates and of filtering; infinite: any texel is legal
};
/// Bound of a texel. Coordinate error e: `st_error`, the error of the texture coordinates `st`, plus 4 u of |st| for
/// the texel coordinates. `arithmetic`: error of the texel itself. The texel is open (slack infinite) where e is not 0
/// and reaches range.gap, the distance to where another texel is the nearest, or where e is half a texel or more of a
/// level that may be filtered linearly: the range holds slopes only within half a texel.
TexelBound texel_bound(const Texture& texture, const TexelRange& range, Vec2<double> st, Vec2<double> st_error,
                       double arithmetic);

/// Predicted open share of a pixel: the bands on both sides of the lines where the nearest texel changes. With w the
/// coordinate's error and s its slope per pixel, both in texels, a band has a half width of w/s pixels. A pixel within
/// one pixel of a line counts w/s; with lines less than two pixels apart (s > 1/2), each pixel counts 2 w. With s <= w
/// a band is at least two pixels wide: the pixel counts 1 with its centre in the band, else 0. A pixel where linear
/// filters have no slopes (texel_bound()) counts 1. `plane`: coordinates and slopes from the triangle's corners, not
/// from the fragment's record, which is judged.
struct OpenShare {
  double area = 0;      ///< pixels, [0,1]
  bool centre = false;  ///< the pixel's centre is in a band
};
OpenShare open_share(const Texture& texture, const TexelRange& range, const PlaneValue& plane, Vec2<double> st_error);

/// Reason why a texel that is not legal is Mesa's fault, or empty. Linear magnification gives way to the nearest
/// texels of mipmaps at a lambda of 1/2 (OpenGL 2.1 spec 3.8.9, c), in Mesa at 0. A lambda of d + 1/2 takes level d
/// (equation 3.25), in Mesa the even one of d and d + 1 (measured: 1.5 and 3.5 go up, 2.5 down); looked for where
/// min_lod or max_lod is such a lambda.
std::string_view mesas_other_level(const Texture& texture, const TexelRange& range);

/// Result of the texture environment for fragment colour `f` and texel `s`, with its error: |d/df| f_error + |d/ds|
/// s_error + the product of both errors, plus the `roundings` of the terms (OpenGL 2.1 spec, tables 3.22, 3.23).
struct Environed {
  Vec4<double> color, error;
};
Environed environ_error(TextureFormat format, const DrawTexture& state, const Vec4<double>& f,
                        const Vec4<double>& f_error, const Vec4<double>& s, const Vec4<double>& s_error,
                        const Roundings& roundings);

}  // namespace plumbline::check

// Textures: how far a texel may be off, and what that comes to in the fragment's colour.
#pragma once

#include <string_view>

#include "capture/legal.h"
#include "capture/stages.h"
#include "check/bounds/bounds.h"
#include "scene/scene.h"

namespace plumbline::check {

/// The texture's largest component, at least 1: what float arithmetic on its texels is proportional to.
double largest_texel(const Texture& texture);

/// How far from the range of legal texels another renderer's may be.
struct TexelBound {
  TexelRange range;
  Vec4<double> slack{0};  ///< by its texture coordinates' errors and its own arithmetic; infinite: it is open
};
/// `st_error`: of its texture coordinates (s, t); 4 u of them more for its texel coordinates, and `arithmetic` of the
/// texel itself. Within st_error of where another texel is the nearest, it is open; of a coordinate that
/// has no error (it is 0 everywhere) that is known. Filtered linearly it is open where st_error is half a texel, beyond
/// which the range knows no slopes.
TexelBound texel_bound(const Texture& texture, const TexelRange& range, Vec2<double> st, Vec2<double> st_error,
                       double arithmetic);

/// What a pixel has of the bands, st_error to either side, along the lines where another texel is the nearest. With w
/// the error and s the slope in texels, a band of half width w/s pixels; a pixel within one of such a line stands for a
/// share w/s of it, and where lines are closer than two pixels, for as much as lies between two. Where the coordinate
/// moves by less than its error (s <= w) there is no such line: the pixel is in the band or it is not. Likewise where
/// linear filters have no slopes (texel_bound). `plane`: coordinates and slopes by the triangle's corners, not by the
/// fragment's record, which is what is judged.
struct OpenShare {
  double area = 0;      ///< pixels, [0,1]
  bool centre = false;  ///< whether its centre is in one
};
OpenShare open_share(const Texture& texture, const TexelRange& range, const PlaneValue& plane, Vec2<double> st_error);

/// Why another texel than the legal ones is Mesa's fault, or empty. Linear magnification gives way to the nearest
/// texels of mipmaps at a lambda of 1/2 (OpenGL 2.1 spec 3.8.9, c), in Mesa at 0. A lambda of d + 1/2 takes level d
/// (equation 3.25), in Mesa the even one of d and d + 1 (measured: 1.5 and 3.5 go up, 2.5 down); it occurs at the
/// limits of lambda.
std::string_view mesas_other_level(const Texture& texture, const TexelRange& range);

/// The colour that fragment colour `f` and texel `s` become, and its error, where theirs are f_error and s_error:
/// |d/df| f_error + |d/ds| s_error + their product, and the `roundings` of the terms (OpenGL 2.1 spec,
/// tables 3.22, 3.23).
struct Environed {
  Vec4<double> color, error;
};
Environed environ_error(TextureFormat format, const DrawTexture& state, const Vec4<double>& f,
                        const Vec4<double>& f_error, const Vec4<double>& s, const Vec4<double>& s_error,
                        const Roundings& roundings);

}  // namespace plumbline::check

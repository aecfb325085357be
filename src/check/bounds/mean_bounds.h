// Error bounds of depths and attributes as weighted means of a triangle's corners.
#pragma once

#include "capture/stages.h"

namespace plumbline::check {

/// Perspective-correct colour at a pixel's centre, extrapolated outside the triangle, and its slopes [1/pixel].
struct PlaneValue {
  Vec4<double> value, d_dx, d_dy;
};
PlaneValue color_of_plane(const WindowTriangle<double>& triangle, int x, int y);

/// Numbers that slopes are computed in.
struct SlopeArithmetic {
  double rounding;  ///< of each term, relative
  double pixels;    ///< distance of the anchor that planes are evaluated from
  /// Slopes may also be differences of values a pixel apart, each with its own rounding.
  bool by_differences = false;
};
inline constexpr SlopeArithmetic kSlopesInDouble{0x1p-51, 128};  ///< from an anchor a tile away

/// Rounding error of color_of_plane()'s slopes, per channel [1/pixel]: `rounding` of the terms of c/w, of 1/w and of
/// their slopes. Far behind a corner beside the eye, c/w and 1/w are small differences of large ones.
Vec4<double> slope_rounding(const WindowTriangle<double>& triangle, int x, int y,
                            const SlopeArithmetic& arithmetic = kSlopesInDouble);

/// Rounding error of a triangle's depth in double [window z]: six roundings, 2^-53 each, of the corners' depths and of
/// both slopes over 128 pixels, as the plane is evaluated at an anchor at most a tile (64 pixels) away. Slopes of 1 per
/// pixel: 1e-13; slopes of 10^7 (slivers beside the eye): a step of z24.
double depth_rounding(const WindowTriangle<double>& triangle);

/// Error of a colour c that is a weighted mean of corners (as the pipeline computes it, and any renderer that works
/// near the triangle), per channel [10 u]: c = c0 + k1 (c1 - c0) + k2 (c2 - c0), k_i = q_i / sum q. The weights have an
/// error of 10 u in proportion to condition = sum |q_i| / |sum q_i|, the two sums of 2 u: (|c| + |c0|) / 5 + condition
/// * (|k1| |c1 - c0| + |k2| |c2 - c0|), plus the rounding in double of a share k_i that is nearly 0. Where q changes
/// little within blocks of 4 x 4 pixels, q may be evaluated in float there: k_i has 4 u (dq_i + |k_i| dq) / |sum q|
/// more, dq_i and dq the changes of q_i and of the sum within a block (kernels/attributes.h, changes_little).
Vec4<double> bounds_of_mean(const WindowTriangle<double>& triangle, int x, int y);

}  // namespace plumbline::check

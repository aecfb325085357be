// Error bounds of depths and attributes as weighted means of a triangle's corners.
#pragma once

#include "capture/stages.h"

namespace plumbline::check {

/// The triangle's perspective-correct colour at a pixel's centre, extrapolated outside it, and its slopes [1/pixel].
struct PlaneValue {
  Vec4<double> value, d_dx, d_dy;
};
PlaneValue color_of_plane(const WindowTriangle<double>& triangle, int x, int y);

/// Rounding error of color_of_plane()'s slopes in double, per channel [1/pixel]: 2^-51 of the terms of
/// c/w, of 1/w and of their slopes, evaluated from an anchor a tile away. Far behind a corner beside the eye, c/w and
/// 1/w are small differences of large ones.
Vec4<double> slope_rounding(const WindowTriangle<double>& triangle, int x, int y);

/// Rounding error of a triangle's depth in double [window z]. The plane is evaluated at an anchor at most a tile (64
/// pixels) away and brought to the pixel, so its terms are the corners' depths and both slopes over 128 pixels; six
/// roundings of 2^-53. With slopes of 1 a pixel 1e-13; with slopes of 10^7 (slivers beside the eye) a step of z24.
double depth_rounding(const WindowTriangle<double>& triangle);

/// For a weighted mean of corners (the pipeline's way, and any that works near the triangle), c0 + k1 (c1 - c0) + k2
/// (c2 - c0) with k_i = q_i / sum q: the weights carry 10 u in proportion to condition = sum |q_i| / |sum q_i|, the two
/// sums 2 u: (|c| + |c0|) / 5 + condition * (|k1| |c1 - c0| + |k2| |c2 - c0|), and what double arithmetic leaves of a
/// share that is 0. Where q changes little within blocks of 4 x 4 pixels, it may be evaluated in float there: 4 u of
/// what q_i changes by, and of |k_i| times what the sum changes by, by the sum (kernels/attributes.h,
/// changes_little).
Vec4<double> bounds_of_mean(const WindowTriangle<double>& triangle, int x, int y);

}  // namespace plumbline::check

// Comparators of stage 8, texture.
#pragma once

#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Compares the candidate's texels with exact's at the candidate's own texture coordinates and levels of detail.
/// Tolerance of texels: `factor` u of the largest component of the draw's texture (at least of 1). Tolerance of
/// levels of detail (lambda): `factor` u of |lambda| (at least of 1), plus the rounding of lambda in double; a lambda
/// below -16, where every texture is magnified, counts as -16.
///
/// `legal`: exact's legal texels of a foreign candidate, or null. A foreign texel may be any that `conventions` allow
/// at the fragment's level of detail or, where that is not shown (NaN), at any legal one, and at texel coordinates that
/// are 4 u off, as in float. A foreign level of detail is exact's, with the rounding of lambda in float, or, where
/// levels are not per pixel, within the legal interval.
Measurement compare_texels(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, const std::vector<TexelRange>* legal = nullptr,
                           const Conventions& conventions = {});

/// Compares the winners' texels [u] where both sides have the same winner: both texels must lie in the candidate's
/// legal.texels, widened by the slack of FragmentBounds::texel(). Where the nearest texel is open, any texel is legal;
/// p such pixels are predicted, and more than 2 p + 6 sqrt(2 p + 1) count as different. `note`: set to both numbers
/// where any pixel is open.
Measurement compare_texel_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor,
                                 std::string& note);

}  // namespace plumbline::check

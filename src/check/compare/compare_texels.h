// Comparators of stage 8, texture.
#pragma once

#include <string>
#include <vector>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// The candidate's texels against exact's at the candidate's own texture coordinates and levels of detail: `factor` u
/// of the largest component of all textures, at least 1. Levels of detail lambda: `factor` u of |lambda|, at least 1,
/// and their rounding in double; all below -16, which no texture is large enough for, count as -16.
///
/// `legal`: exact's legal texels of a foreign candidate, or null. Its texel may be any that `conventions` allow at its
/// level of detail or, where it hands out none (NaN), at any legal one; its level of detail is exact's or, where levels
/// are not per pixel, within the legal interval.
Measurement compare_texels(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor, const std::vector<TexelRange>* legal = nullptr,
                           const Conventions& conventions = {});

/// The winners' texels where the winners are the same, in u: within the candidate's legal.texels and FragmentBounds'
/// slack. Where it is open which texel is the nearest, any is legal. Of such pixels p are predicted; more than
/// 2 p + 6 sqrt(2 p + 1) are different. `note`: both numbers.
Measurement compare_texel_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor,
                                 std::string& note);

}  // namespace plumbline::check

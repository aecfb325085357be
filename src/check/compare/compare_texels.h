// Comparators of stage 8, texture.
#pragma once

#include <string>

#include "capture/capture.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// The candidate's texels against exact's at the candidate's own texture coordinates and levels of detail: `factor` u
/// of the texture's largest component, at least 1. And the levels of detail themselves: `factor` u of |lambda|, at
/// least 1, those below -16 alike, for which no texture has enough texels.
Measurement compare_texels(const Scene& scene, const Records<double>& candidate, const Records<double>& reference,
                           double factor);

/// The winners' texels where the winners are the same, in u: within the candidate's legal.texels and FragmentBounds'
/// slack. Where it is open which texel is the nearest, any is legal; how many such pixels there may be is predicted,
/// and twice as many, with three standard deviations, are different. `note`: both numbers.
Measurement compare_texel_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor,
                                 std::string& note);

}  // namespace plumbline::check

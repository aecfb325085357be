// Blending of the fragments that a candidate's records show, in float frames.
#pragma once

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline::check {

/// True if a blend factor reads the frame's colour or alpha: an error of the frame's colour may then double with each
/// layer, for colours of at most 1.
bool factors_read_frame(const Scene& scene);

/// Rounding error of each pixel's colour by blending n fragments in float [u]: 4 n, or 4 (2^n - 1) where any blend
/// factor reads the frame (colours of at most 1), times the sum of the largest |components| of the clear and the
/// fragments' colours, at least 1 each. 0 where no fragment is drawn.
Plane<double> blending_roundings(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::check

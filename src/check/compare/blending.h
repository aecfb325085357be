// Blending of the fragments that a candidate's records show, in float frames.
#pragma once

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline::check {

/// True if a blend factor reads the frame's colour or alpha: an error of the frame's colour may then double with each
/// layer, for colours of at most 1.
bool factors_read_frame(const Scene& scene);

/// Rounding error of each pixel's colour by blending in float [u]: per layer, the error so far times what the factors
/// let through, plus 4 u of the sum of both terms' absolute values (factors that sum to 1: of both colours', times the
/// larger factor above 1). Source colours: `records.shaded`; without these, at most 1. 0 where no fragment is drawn.
Plane<double> blending_roundings(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::check

// Blending of the fragments that a candidate's records show, in float frames.
#pragma once

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Whether any draw has a blend factor that reads the frame's colour or alpha: an error of the frame's colour may then
/// double with each layer.
bool factors_read_frame(const Scene& scene);

/// Rounding error of each pixel's colour by blending n fragments in float [u]: 4 n, or 4 (2^n - 1) where any blend
/// factor reads the frame, times the largest value that the clear colour and the fragments' colours may sum up to. 0
/// where no fragment is drawn.
Plane<double> blending_roundings(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::check

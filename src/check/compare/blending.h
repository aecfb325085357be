// Blending of the fragments that a candidate's records show, in float frames.
#pragma once

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Whether a factor of any draw is of the frame's colour: an error of the frame then doubles with each layer.
bool factors_read_frame(const Scene& scene);

/// Roundings of each pixel's colour by blending in float [u]: 4 a layer, of the largest value that the layers may sum up
/// to; 0 where no fragment is drawn.
Plane<double> blending_roundings(const Scene& scene, const Records<double>& records);

}  // namespace plumbline::check

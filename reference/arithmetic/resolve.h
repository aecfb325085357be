// Stage 12 in double: the passes of an antialiased scene are resolved into one frame.
#pragma once

#include <vector>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::math {

/// The weighted mean of each pixel's samples, not rounded to codes. `samples`: the colour plane of each pass, codes as
/// code / (2^n - 1).
Plane<glm::vec4> mean_colors(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples);
/// mean_colors() in the frame's format: rounded to the nearest code, halves up.
Plane<glm::vec4> resolved_colors(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples);

/// Capture of an antialiased scene (renderer.h) from the renderer's captures of its passes: samples, resolved colour,
/// depth of the first sample. Throws OverBudget, and the exceptions of the renderer's capture().
Capture capture_resolved(Renderer& renderer, const Scene& scene, const Request& request);

}  // namespace plumbline::math

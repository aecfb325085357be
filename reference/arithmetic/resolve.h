// Stage 12 in double: the passes of an antialiased scene become one frame.
#pragma once

#include <vector>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::math {

/// The weighted mean of each pixel's samples. Codes (as code / (2^n - 1)) are not rounded to codes.
Plane<glm::vec4> mean_colors(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples);
/// The same in the frame's format: codes rounded to the nearest, halves up.
Plane<glm::vec4> resolved_colors(const FrameFormat& frame, const std::vector<Plane<glm::vec4>>& samples);

/// A renderer's capture of an antialiased scene (renderer.h) from its captures of the passes.
Capture capture_resolved(Renderer& renderer, const Scene& scene, const Request& request);

}  // namespace plumbline::math

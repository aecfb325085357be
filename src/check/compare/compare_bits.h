// Pictures compared bit for bit: -0 is not 0, and a NaN equals a NaN of the same bits alone.
#pragma once

#include "capture/capture.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Compares colours [steps of the format; float formats: the values' own unit].
Measurement compare_color_bits(const Plane<glm::vec4>& candidate, const Plane<glm::vec4>& reference,
                               ColorFormat format);
/// Compares depths [steps of the format; float formats: window z].
Measurement compare_depth_bits(const Plane<double>& candidate, const Plane<double>& reference, DepthFormat format);

/// The finished frame: colour, depth, and stencil values where the format has them. The worst of the three planes.
Measurement compare_picture(const FrameFormat& format, const Planes& candidate, const Planes& reference);

}  // namespace plumbline::check

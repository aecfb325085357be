// Pictures compared bit for bit: -0 is not 0, and a NaN equals a NaN of the same bits alone.
#pragma once

#include "capture/capture.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Colours, in steps of the format (of float: in numbers).
Measurement compare_color_bits(const Plane<glm::vec4>& candidate, const Plane<glm::vec4>& reference,
                               ColorFormat format);
/// Depths, in steps of the format (of float: in window z).
Measurement compare_depth_bits(const Plane<double>& candidate, const Plane<double>& reference, DepthFormat format);

/// The finished frame: colour, depth, and stencil values where the format has them. The worst of the three planes.
Measurement compare_picture(const FrameFormat& format, const Planes& candidate, const Planes& reference);

}  // namespace plumbline::check

// Stage 5: which pixel centres a triangle, line or point covers.
#pragma once

#include <vector>

#include "kernels/coverage.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// The box's pixels that are also the frame's.
PixelBounds scissored(const Scissor& box, const PixelBounds& frame);

/// Those within `box`, row by row from the bottom, from left to right.
std::vector<glm::ivec2> covered_pixels(const WindowTriangle& triangle, const PixelBounds& box);
/// The same of a triangle by other edges, or by other bounds.
std::vector<glm::ivec2> covered_pixels(const Edges& edges, const PixelBounds& bounds, const PixelBounds& box);

/// The frame's pixels.
PixelBounds bounds_of(const FrameFormat& frame);

}  // namespace plumbline::pipeline

// A line's or a point's pixels as a list.
#pragma once

#include <vector>

#include "pipeline/coverage.h"

namespace plumbline {

/// The pixels of a line or point within the `size` x `size` that begin at pixel `origin`, as the pipeline has them.
inline std::vector<glm::ivec2> thin_pixels(const WindowTriangle<float>& line_or_point, glm::ivec2 origin, int size) {
  std::vector<glm::ivec2> pixels;
  pipeline::visit_thin_pixels(line_or_point, origin, size, [&](glm::ivec2 p) { pixels.push_back(p); });
  return pixels;
}

}  // namespace plumbline

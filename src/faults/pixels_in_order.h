// A line's or a point's pixels in the order in which they are exited.
#pragma once

#include <vector>

#include "kernels/coverage.h"

namespace plumbline {

inline std::vector<glm::ivec2> pixels_in_order(const pipeline::WindowTriangle& line_or_point,
                                               const pipeline::PixelBounds& box) {
  std::vector<glm::ivec2> pixels;
  if (box.x0 >= box.x1 || box.y0 >= box.y1) return pixels;
  pipeline::visit_line_or_point(line_or_point, {box.x0, box.y0}, {box.x1 - box.x0, box.y1 - box.y0},
                                [&](glm::ivec2 p) { pixels.push_back(p); });
  return pixels;
}

}  // namespace plumbline

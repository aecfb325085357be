#include "pipeline/coverage.h"

#include <algorithm>
#include <tuple>

namespace plumbline::pipeline {

namespace {

PixelBounds intersection(const PixelBounds& a, const PixelBounds& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

}  // namespace

PixelBounds bounds_of(const FrameFormat& frame) { return {0, 0, frame.width, frame.height}; }

PixelBounds scissored(const Scissor& box, const PixelBounds& frame) {
  return intersection({box.x, box.y, box.x + box.width, box.y + box.height}, frame);
}

std::vector<glm::ivec2> covered_pixels(const Edges& edges, const PixelBounds& bounds, const PixelBounds& box) {
  const PixelBounds b = intersection(bounds, box);
  std::vector<glm::ivec2> out;
  for (int y = b.y0; y < b.y1; ++y) {
    for (int x = b.x0; x < b.x1; ++x) {
      if (coverage<float>(edges, {x, y, 0, 0})) out.emplace_back(x, y);
    }
  }
  return out;
}

std::vector<glm::ivec2> covered_pixels(const WindowTriangle& triangle, const PixelBounds& box) {
  if (triangle.corners == 3) return covered_pixels(edges_of(triangle), pixel_bounds(triangle), box);
  std::vector<glm::ivec2> out;
  const glm::ivec2 size(box.x1 - box.x0, box.y1 - box.y0);
  if (size.x <= 0 || size.y <= 0) return out;
  visit_line_or_point(triangle, {box.x0, box.y0}, size, [&](glm::ivec2 pixel) { out.push_back(pixel); });
  std::ranges::stable_sort(out, {}, [](const glm::ivec2& p) { return std::tuple(p.y, p.x); });
  return out;
}

}  // namespace plumbline::pipeline

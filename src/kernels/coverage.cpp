#include "kernels/coverage.h"

#include <algorithm>
#include <tuple>

namespace plumbline::pipeline {

Edges edges_of(const WindowTriangle& triangle) {
  glm::i64vec2 corner[3] = {triangle.v[0].snapped, triangle.v[1].snapped, triangle.v[2].snapped};
  if (!triangle.front) std::swap(corner[1], corner[2]);  // counter-clockwise
  Edges edges{};
  for (int i = 0; i < 3; ++i) {
    const glm::i64vec2 a = corner[i], d = corner[(i + 1) % 3] - a;
    edges.step_x[i] = -d.y * kSubpixel;
    edges.step_y[i] = d.x * kSubpixel;
    // tie rule left_bottom: a step into the triangle is one to +x, or, at a horizontal edge, to +y.
    const bool owns_its_centres = d.y < 0 || (d.y == 0 && d.x > 0);
    edges.at_origin[i] = d.y * a.x - d.x * a.y - (owns_its_centres ? 0 : 1);
  }
  return edges;
}

PixelBounds pixel_bounds(const WindowTriangle& triangle) {
  const auto& v = triangle.v;
  const auto [x_min, x_max] = std::minmax({v[0].snapped.x, v[1].snapped.x, v[2].snapped.x});
  const auto [y_min, y_max] = std::minmax({v[0].snapped.y, v[1].snapped.y, v[2].snapped.y});
  const auto up = [](int snapped) { return (snapped + kSubpixel - 1) >> 8; };  // the first centre at or after it
  const auto down = [](int snapped) { return snapped >> 8; };                  // the last at or before it
  const int reach = triangle.corners < 3 ? static_cast<int>(triangle.width) : 0;
  return {up(x_min) - reach, up(y_min) - reach, down(x_max) + 1 + reach, down(y_max) + 1 + reach};
}

PixelBounds bounds_of(const FrameFormat& frame) { return {0, 0, frame.width, frame.height}; }

PixelBounds scissored(const Scissor& box, const PixelBounds& frame) {
  return intersection({box.x, box.y, box.x + box.width, box.y + box.height}, frame);
}

std::vector<glm::ivec2> covered_pixels(const Edges& edges, const PixelBounds& bounds, const PixelBounds& box) {
  std::vector<glm::ivec2> out;
  visit_inside(edges, intersection(bounds, box), [&](glm::ivec2 pixel) { out.push_back(pixel); });
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

#include "kernels/coverage.h"

#include <algorithm>

namespace plumbline::pipeline {

Edges edges_of(const WindowTriangle& triangle) {
  glm::i64vec2 corner[3] = {triangle.v[0].snapped, triangle.v[1].snapped, triangle.v[2].snapped};
  if (!triangle.front) std::swap(corner[1], corner[2]);  // counter-clockwise
  Edges edges{};
  for (int i = 0; i < 3; ++i) {
    const glm::i64vec2 a = corner[i], d = corner[(i + 1) % 3] - a;
    edges.step_x[i] = -d.y * kSubpixel;
    edges.step_y[i] = d.x * kSubpixel;
    // TieRule::small_sides_in: a step into the triangle is one to +x, or, at a horizontal edge, to +y.
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

}  // namespace plumbline::pipeline

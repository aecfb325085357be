#include "pipeline/coverage.h"

#include <algorithm>

#include "pipeline/window.h"
#include "raster/line_diamond.h"

namespace plumbline::pipeline {

namespace {

// The edge's own centres are in if a step into the triangle is a step to +x, or, for a horizontal edge, to +y.
bool owns_its_centres(std::int64_t step_x, std::int64_t step_y, TieRule rule) {
  switch (rule) {
    case TieRule::small_sides_in: return step_x > 0 || (step_x == 0 && step_y > 0);
  }
  return false;
}

}  // namespace

Edges edges_of(const WindowTriangle<float>& triangle, TieRule rule) {
  glm::i64vec2 corner[3] = {triangle.v[0].snapped, triangle.v[1].snapped, triangle.v[2].snapped};
  if (!triangle.front) std::swap(corner[1], corner[2]);  // counter-clockwise
  Edges edges{};
  for (int i = 0; i < 3; ++i) {
    const glm::i64vec2 a = corner[i], d = corner[(i + 1) % 3] - a;
    edges.step_x[i] = -d.y * kSubpixel;
    edges.step_y[i] = d.x * kSubpixel;
    edges.at_origin[i] = d.y * a.x - d.x * a.y - (owns_its_centres(-d.y, d.x, rule) ? 0 : 1);
  }
  return edges;
}

PixelBounds pixel_bounds(const WindowTriangle<float>& triangle) {
  const auto& v = triangle.v;
  const auto [x_min, x_max] = std::minmax({v[0].snapped.x, v[1].snapped.x, v[2].snapped.x});
  const auto [y_min, y_max] = std::minmax({v[0].snapped.y, v[1].snapped.y, v[2].snapped.y});
  const auto up = [](int snapped) { return (snapped + kSubpixel - 1) >> 8; };  // the first centre at or after it
  const auto down = [](int snapped) { return snapped >> 8; };                  // the last at or before it
  const int reach = triangle.corners < 3 ? static_cast<int>(triangle.width) : 0;
  return {up(x_min) - reach, up(y_min) - reach, down(x_max) + 1 + reach, down(y_max) + 1 + reach};
}

namespace {

// Ends relative to the box's first pixel.
std::vector<glm::ivec2> line_pixels(glm::i64vec2 a, glm::i64vec2 b, int width, int size) {
  if (width == 1) return raster::diamond_exit_line(a, b, glm::ivec2(size));
  const glm::i64vec2 d = glm::abs(b - a);
  const int minor = d.x >= d.y ? 1 : 0;
  glm::i64vec2 moved(0);  // so that what begins below the box, and reaches into it, is seen
  moved[minor] = kSubpixel * (width - 1) - kSubpixel / 2 * (width - 1);
  glm::ivec2 box(size);
  box[minor] += width - 1;
  std::vector<glm::ivec2> pixels;
  for (glm::ivec2 p : raster::diamond_exit_line(a + moved, b + moved, box)) {
    p[minor] -= width - 1;
    for (int k = 0; k < width; ++k, ++p[minor]) {
      if (p[minor] >= 0 && p[minor] < size) pixels.push_back(p);
    }
  }
  return pixels;
}

std::vector<glm::ivec2> point_pixels(glm::i64vec2 at, int width, int size) {
  const glm::ivec2 first((at + std::int64_t{kSubpixel / 2 * (2 - width)}) >> std::int64_t{8});
  std::vector<glm::ivec2> pixels;
  for (int y = std::max(first.y, 0); y < std::min(first.y + width, size); ++y) {
    for (int x = std::max(first.x, 0); x < std::min(first.x + width, size); ++x) pixels.emplace_back(x, y);
  }
  return pixels;
}

}  // namespace

std::vector<glm::ivec2> thin_pixels(const WindowTriangle<float>& line_or_point, glm::ivec2 origin, int size) {
  const glm::i64vec2 a = glm::i64vec2(line_or_point.v[0].snapped) - std::int64_t{kSubpixel} * glm::i64vec2(origin);
  const glm::i64vec2 b = glm::i64vec2(line_or_point.v[1].snapped) - std::int64_t{kSubpixel} * glm::i64vec2(origin);
  const auto width = static_cast<int>(line_or_point.width);
  std::vector<glm::ivec2> pixels =
      line_or_point.corners == 2 ? line_pixels(a, b, width, size) : point_pixels(a, width, size);
  for (glm::ivec2& p : pixels) p += origin;
  return pixels;
}

}  // namespace plumbline::pipeline

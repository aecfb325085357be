#include <algorithm>
#include <cstdint>

#include "notes/raster/triangle_algorithms.h"

namespace plumbline::raster {

namespace {

std::int64_t cross(glm::i64vec2 a, glm::i64vec2 b) { return a.x * b.y - a.y * b.x; }

/// True: q is on the inner (left) side of the edge from -> to of a counter-clockwise triangle, or on an edge that goes
/// down (the interior is to the right in the window) or straight to the right (the interior is above).
bool is_left_of(glm::i64vec2 from, glm::i64vec2 to, glm::i64vec2 q) {
  const glm::i64vec2 walk = to - from;
  const std::int64_t z = cross(walk, q - from);
  if (z != 0) return z > 0;
  return walk.y < 0 || (walk.y == 0 && walk.x > 0);
}

}  // namespace

Spans cover_by_cross_products(const Corners& corners, int width, int height) {
  require_in_range(corners, width, height);
  glm::i64vec2 p0 = corners[0], p1 = corners[1], p2 = corners[2];
  const std::int64_t turn = cross(p1 - p0, p2 - p0);
  if (turn == 0) return {};
  if (turn < 0) std::swap(p1, p2);  // counter-clockwise: all three signs are positive inside

  const auto in_frame = [](std::int64_t pixel, int side) {
    return static_cast<int>(std::clamp<std::int64_t>(pixel, -1, side));
  };
  const glm::i64vec2 low = glm::min(p0, glm::min(p1, p2)), high = glm::max(p0, glm::max(p1, p2));
  const int x_end = in_frame((high.x >> 8) + 1, width), y_end = in_frame((high.y >> 8) + 1, height);

  Spans out;
  for (int y = std::max(in_frame(low.y >> 8, height), 0); y < y_end; ++y) {
    for (int x = std::max(in_frame(low.x >> 8, width), 0); x < x_end; ++x) {
      const glm::i64vec2 q(256 * x, 256 * y);
      if (is_left_of(p0, p1, q) && is_left_of(p1, p2, q) && is_left_of(p2, p0, q)) append_pixel(x, y, out);
    }
  }
  return out;
}

}  // namespace plumbline::raster

#include <algorithm>
#include <cstdint>

#include "notes/raster/triangle_algorithms.h"

namespace plumbline::raster {

namespace {

/// An edge's expression at one pixel, >= 0 inside. Left edges (the triangle to their right) and bottom edges
/// (horizontal, the triangle above) own the pixels on them. The expressions of other edges are lowered by 1: of
/// integers, that changes the sign of 0 alone.
struct Expression {
  std::int64_t value, step_x, step_y;  // from pixel to pixel
};

Expression expression_at(int pixel_x, int pixel_y, glm::i64vec2 tail, glm::i64vec2 head, glm::i64vec2 third) {
  const std::int64_t dx = head.x - tail.x, dy = head.y - tail.y;
  const auto e = [&](std::int64_t x, std::int64_t y) { return dy * (x - tail.x) - dx * (y - tail.y); };
  const int side = e(third.x, third.y) > 0 ? 1 : -1;
  const bool is_left = side * dy > 0, is_bottom = dy == 0 && side * dx < 0;
  const std::int64_t own = is_left || is_bottom ? 0 : 1;
  return {side * e(256 * pixel_x, 256 * pixel_y) - own, side * dy * 256, -side * dx * 256};
}

}  // namespace

Spans cover_by_lee(const Corners& corners, int width, int height) {
  require_in_range(corners, width, height);
  const auto& [a, b, c] = corners;
  const auto [x_low, x_high] = std::minmax({a.x, b.x, c.x});
  const auto [y_low, y_high] = std::minmax({a.y, b.y, c.y});
  // The first centre at or after the low ends, and the last at or before the high ones.
  const int x_first = std::max((x_low + 255) / 256, 0), x_last = std::min(x_high >> 8, width - 1);
  const int y_first = std::max((y_low + 255) / 256, 0), y_last = std::min(y_high >> 8, height - 1);

  Expression row[3] = {expression_at(x_first, y_first, a, b, c), expression_at(x_first, y_first, b, c, a),
                       expression_at(x_first, y_first, c, a, b)};
  Spans out;
  for (int y = y_first; y <= y_last; ++y) {
    std::int64_t e0 = row[0].value, e1 = row[1].value, e2 = row[2].value;
    for (int x = x_first; x <= x_last; ++x) {
      if (e0 >= 0 && e1 >= 0 && e2 >= 0) append_pixel(x, y, out);
      e0 += row[0].step_x, e1 += row[1].step_x, e2 += row[2].step_x;
    }
    for (Expression& e : row) e.value += e.step_y;
  }
  return out;
}

}  // namespace plumbline::raster

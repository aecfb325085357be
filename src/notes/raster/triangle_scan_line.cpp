#include <algorithm>
#include <cstdint>

#include "notes/raster/triangle_algorithms.h"

namespace plumbline::raster {

namespace {

/// ceil(n / d), d > 0.
std::int64_t round_up(std::int64_t n, std::int64_t d) { return n / d + (n % d > 0 ? 1 : 0); }

/// The first pixel of row y whose centre is at or to the right of the edge, which goes up and crosses the row:
/// x = low.x + (256 y - low.y) dx / dy, rounded up to a pixel.
std::int64_t first_right_of(glm::i64vec2 low, glm::i64vec2 high, std::int64_t y) {
  const std::int64_t dx = high.x - low.x, dy = high.y - low.y;
  return round_up(low.x * dy + (256 * y - low.y) * dx, 256 * dy);
}

}  // namespace

// Half-open intervals settle ties: rows from the lowest corner, included, to the highest, excluded; pixels of a row
// from the left edge, included, to the right one, excluded.
Spans cover_by_scan_line(const Corners& corners, int width, int height) {
  require_in_range(corners, width, height);
  std::array<glm::i64vec2, 3> p{corners[0], corners[1], corners[2]};
  std::sort(p.begin(), p.end(), [](const glm::i64vec2& a, const glm::i64vec2& b) { return a.y < b.y; });
  const auto& [low, middle, high] = p;
  const std::int64_t y_end = std::min<std::int64_t>(round_up(high.y, 256), height);

  Spans out;
  for (std::int64_t y = std::max<std::int64_t>(round_up(low.y, 256), 0); y < y_end; ++y) {
    const std::int64_t by_long_side = first_right_of(low, high, y);
    const std::int64_t by_short_side =
        256 * y < middle.y ? first_right_of(low, middle, y) : first_right_of(middle, high, y);
    const std::int64_t begin = std::max<std::int64_t>(std::min(by_long_side, by_short_side), 0);
    const std::int64_t end = std::min<std::int64_t>(std::max(by_long_side, by_short_side), width);
    if (begin < end) out.push_back({static_cast<int>(y), static_cast<int>(begin), static_cast<int>(end)});
  }
  return out;
}

}  // namespace plumbline::raster

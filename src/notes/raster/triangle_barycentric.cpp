#include <algorithm>
#include <cstdint>

#include "notes/raster/triangle_algorithms.h"

namespace plumbline::raster {

namespace {

int sign_of(std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

/// Sign of one barycentric coordinate, such as alpha = f12(p) / f12(p0): the sign of f12(p) times that of f12(p0),
/// without a division. 0 everywhere for a triangle without area.
class Coordinate {
 public:
  /// The coordinate of vertex k, by the line through i and j.
  Coordinate(glm::i64vec2 i, glm::i64vec2 j, glm::i64vec2 k)
      : a_(i.y - j.y), b_(j.x - i.x), c_(i.x * j.y - j.x * i.y), at_own_vertex_(sign_of(f(k.x, k.y))) {}

  int sign(std::int64_t x, std::int64_t y) const { return sign_of(f(x, y)) * at_own_vertex_; }

  /// True: the coordinate is positive. Where the centre is on the line (0), the coordinate one step to the right
  /// decides; if 0 as well, the one a step above.
  bool accepts(std::int64_t x, std::int64_t y) const {
    if (const int here = sign(x, y); here != 0) return here > 0;
    if (const int right = sign(x + 1, y); right != 0) return right > 0;
    return sign(x, y + 1) > 0;
  }

 private:
  std::int64_t f(std::int64_t x, std::int64_t y) const { return a_ * x + b_ * y + c_; }

  std::int64_t a_, b_, c_;
  int at_own_vertex_;
};

}  // namespace

Spans cover_by_barycentric(const Corners& corners, int width, int height) {
  require_in_range(corners, width, height);
  const auto& [p0, p1, p2] = corners;
  const Coordinate alpha(p1, p2, p0), beta(p2, p0, p1), gamma(p0, p1, p2);

  const auto floor_pixel = [](int v) { return v >> 8; };
  const auto ceil_pixel = [](int v) { return -(-v >> 8); };
  const int x_min = std::max(floor_pixel(std::min({p0.x, p1.x, p2.x})), 0);
  const int x_max = std::min(ceil_pixel(std::max({p0.x, p1.x, p2.x})), width - 1);
  const int y_min = std::max(floor_pixel(std::min({p0.y, p1.y, p2.y})), 0);
  const int y_max = std::min(ceil_pixel(std::max({p0.y, p1.y, p2.y})), height - 1);

  Spans out;
  for (int y = y_min; y <= y_max; ++y) {
    for (int x = x_min; x <= x_max; ++x) {
      const std::int64_t px = 256 * x, py = 256 * y;
      if (alpha.accepts(px, py) && beta.accepts(px, py) && gamma.accepts(px, py)) append_pixel(x, y, out);
    }
  }
  return out;
}

}  // namespace plumbline::raster

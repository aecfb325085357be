#include "notes/raster/line.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::raster {

namespace {

// A line reflected into the octant 0 <= a <= n: the octant's pixel (x, y) is start + x * major + y * minor.
struct Octant {
  glm::i64vec2 start, major, minor;
  std::int64_t n, a;
};

Octant octant_of(glm::ivec2 from, glm::ivec2 to) {
  constexpr int kFarthest = 1 << 29;  // keeps 2 n a below 2^62
  for (const glm::ivec2 p : {from, to})
    if (p.x < -kFarthest || p.x > kFarthest || p.y < -kFarthest || p.y > kFarthest)
      throw std::invalid_argument(
          fmt::format("expected a line's ends within +-{}, found pixel {}, {}", kFarthest, p.x, p.y));
  const glm::i64vec2 d = glm::i64vec2(to) - glm::i64vec2(from);
  const glm::i64vec2 x(d.x < 0 ? -1 : 1, 0), y(0, d.y < 0 ? -1 : 1);
  const std::int64_t dx = std::abs(d.x), dy = std::abs(d.y);
  return dx >= dy ? Octant{from, x, y, dx, dy} : Octant{from, y, x, dy, dx};
}

// The steps [first, last] of the line whose pixels' major coordinate is within the frame; first > last: none.
struct Steps {
  std::int64_t first, last;
};
Steps steps_within(const Octant& o, glm::ivec2 frame) {
  const bool along_x = o.major.x != 0;
  const std::int64_t start = along_x ? o.start.x : o.start.y, size = along_x ? frame.x : frame.y;
  const bool forward = o.major.x + o.major.y > 0;
  const Steps all = forward ? Steps{-start, size - 1 - start} : Steps{start - (size - 1), start};
  return {std::max<std::int64_t>(all.first, 0), std::min(all.last, o.n)};
}

// ROUND(k x), half towards E: the largest integer less than k x + 1/2.
std::int64_t round_to_e(const Octant& o, std::int64_t x) { return o.n == 0 ? 0 : (2 * o.a * x + o.n - 1) / (2 * o.n); }

// Collects a line's pixels within the frame, with their depth and colour.
class Drawn {
 public:
  Drawn(const LinePixel& from, const LinePixel& to, const Octant& octant, glm::ivec2 frame)
      : from_(from), to_(to), octant_(octant), frame_(frame) {}

  void add(std::int64_t x, std::int64_t y) {
    const glm::i64vec2 p = octant_.start + x * octant_.major + y * octant_.minor;
    if (p.x < 0 || p.y < 0 || p.x >= frame_.x || p.y >= frame_.y) return;
    const float t = octant_.n == 0 ? 0.0f : static_cast<float>(static_cast<double>(x) / static_cast<double>(octant_.n));
    pixels_.push_back({glm::ivec2(p), (1 - t) * from_.depth + t * to_.depth, (1 - t) * from_.color + t * to_.color});
  }
  std::vector<LinePixel> take() { return std::move(pixels_); }

 private:
  const LinePixel& from_;
  const LinePixel& to_;
  const Octant& octant_;
  glm::ivec2 frame_;
  std::vector<LinePixel> pixels_;
};

}  // namespace

std::vector<LinePixel> brute_force_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame) {
  const Octant o = octant_of(from.pixel, to.pixel);
  const Steps steps = steps_within(o, frame);
  Drawn drawn(from, to, o, frame);
  for (std::int64_t x = steps.first; x <= steps.last; ++x) drawn.add(x, round_to_e(o, x));
  return drawn.take();
}

std::vector<LinePixel> incremental_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame) {
  const Octant o = octant_of(from.pixel, to.pixel);
  const float k = o.n == 0 ? 0.0f : static_cast<float>(o.a) / static_cast<float>(o.n);
  Drawn drawn(from, to, o, frame);
  float y = 0;
  for (std::int64_t x = 0; x <= o.n; ++x, y += k) drawn.add(x, static_cast<std::int64_t>(std::ceil(y - 0.5f)));
  return drawn.take();
}

std::vector<LinePixel> midpoint_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame) {
  const Octant o = octant_of(from.pixel, to.pixel);
  const Steps steps = steps_within(o, frame);
  const std::int64_t a = o.a, b = -o.n;
  Drawn drawn(from, to, o, frame);
  // f is set up at the first pixel within the frame, not at the line's start.
  std::int64_t y = round_to_e(o, steps.first);
  std::int64_t twice_f = 2 * a * (steps.first + 1) + b * (2 * y + 1);
  for (std::int64_t x = steps.first; x <= steps.last; ++x) {
    drawn.add(x, y);
    if (twice_f > 0) {  // the line passes above the middle: NE
      ++y;
      twice_f += 2 * (a + b);
    } else {
      twice_f += 2 * a;
    }
  }
  return drawn.take();
}

}  // namespace plumbline::raster

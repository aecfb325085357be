#include "reference/exact/line_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>

#include "reference/exact/wide.h"

namespace plumbline::exact {
namespace {

// c0 + c1 e + c2 e^2.
struct Infinitesimal {
  Int128 c0, c1, c2;
  auto operator<=>(const Infinitesimal&) const = default;
};
Infinitesimal operator*(Infinitesimal a, Int128 b) { return {a.c0 * b, a.c1 * b, a.c2 * b}; }
constexpr Infinitesimal kZero{0, 0, 0};

// Half plane of a diamond's side: 1/2 - (sx dx + sy dy) [1/256 pixel], (dx, dy) the moved point relative to the pixel's
// centre; positive inside.
Infinitesimal inside(glm::i64vec2 p, glm::i64vec2 pixel, int sx, int sy) {
  const Int128 dx = Int128{p.x} - Int128{256} * pixel.x, dy = Int128{p.y} - Int128{256} * pixel.y;
  return {128 - (sx * dx + sy * dy), sx, sy};
}

constexpr std::array<std::array<int, 2>, 4> kDiamondSides = {{{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

bool contains(glm::i64vec2 p, glm::i64vec2 pixel) {
  return std::all_of(kDiamondSides.begin(), kDiamondSides.end(),
                     [&](auto s) { return inside(p, pixel, s[0], s[1]) > kZero; });
}

// A parameter of the segment: at / over, 0 at a and 1 at b.
struct Parameter {
  Infinitesimal at;
  Int128 over;  // > 0
};
bool operator<(const Parameter& s, const Parameter& t) { return s.at * t.over < t.at * s.over; }

}  // namespace

bool produces(glm::i64vec2 a, glm::i64vec2 b, glm::i64vec2 pixel) {
  if (contains(b, pixel)) return false;
  if (contains(a, pixel)) return true;
  // With neither end inside, the part inside is an open interval, not empty if enter < leave.
  Parameter enter{kZero, 1}, leave{{1, 0, 0}, 1};
  for (const auto& [sx, sy] : kDiamondSides) {
    const Infinitesimal at_a = inside(a, pixel, sx, sy);
    const Int128 change = inside(b, pixel, sx, sy).c0 - at_a.c0;  // both ends are moved alike
    if (change == 0 && !(at_a > kZero)) return false;
    if (change > 0) enter = std::max(enter, Parameter{at_a * -1, change});
    if (change < 0) leave = std::min(leave, Parameter{at_a, -change});
  }
  return enter < leave;
}

std::vector<glm::ivec2> line_pixels(glm::i64vec2 a, glm::i64vec2 b, int width, int height) {
  std::vector<glm::ivec2> pixels;
  const auto [low, high] = std::minmax(a.y, b.y);
  const auto row_of = [](std::int64_t y) {
    return static_cast<int>(std::clamp<std::int64_t>(y / 256, -(1 << 30), 1 << 30));
  };
  for (int j = std::max(0, row_of(low) - 2); j <= std::min(height - 1, row_of(high) + 2); ++j) {
    // Superset of the columns that the segment passes within a row of this one: two more on either side.
    const auto x_at = [&](double y) {
      const double t = a.y == b.y ? 0 : (y - static_cast<double>(a.y)) / static_cast<double>(b.y - a.y);
      return static_cast<double>(a.x) + std::clamp(t, 0.0, 1.0) * static_cast<double>(b.x - a.x);
    };
    double x0 = x_at(256.0 * (j - 1)), x1 = x_at(256.0 * (j + 1));
    if (a.y == b.y) x0 = static_cast<double>(a.x), x1 = static_cast<double>(b.x);
    if (x0 > x1) std::swap(x0, x1);
    const int first = static_cast<int>(std::clamp(x0 / 256 - 2, 0.0, static_cast<double>(width)));
    const int last = static_cast<int>(std::clamp(x1 / 256 + 2, -1.0, width - 1.0));
    for (int i = first; i <= last; ++i)
      if (produces(a, b, {i, j})) pixels.emplace_back(i, j);
  }
  return pixels;
}

std::vector<glm::ivec2> wide_line_pixels(glm::i64vec2 a, glm::i64vec2 b, int w, int width, int height) {
  const bool x_major = std::abs(b.x - a.x) >= std::abs(b.y - a.y);
  // A frame that begins w - 1 pixels earlier holds the lowest fragment of each column of which any fragment is visible.
  const glm::i64vec2 minor = x_major ? glm::i64vec2(0, 1) : glm::i64vec2(1, 0);
  const glm::i64vec2 moved = minor * std::int64_t{256 * (w - 1) - 128 * (w - 1)};
  const glm::ivec2 earlier = glm::ivec2(minor) * (w - 1);
  std::vector<glm::ivec2> pixels;
  for (const glm::ivec2 lowest : line_pixels(a + moved, b + moved, width + earlier.x, height + earlier.y))
    for (int k = 0; k < w; ++k) {
      const glm::ivec2 p = lowest - earlier + glm::ivec2(minor) * k;
      if (p.x >= 0 && p.y >= 0 && p.x < width && p.y < height) pixels.push_back(p);
    }
  std::sort(pixels.begin(), pixels.end(),
            [](glm::ivec2 p, glm::ivec2 q) { return p.y != q.y ? p.y < q.y : p.x < q.x; });
  return pixels;
}

}  // namespace plumbline::exact

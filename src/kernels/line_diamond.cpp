#include "kernels/line_diamond.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::raster {

namespace {

constexpr std::int64_t kUnit = 256, kHalf = 128;

std::int64_t floor_div(std::int64_t n, std::int64_t d) { return n / d - (n % d < 0); }
std::int64_t ceil_div(std::int64_t n, std::int64_t d) { return -floor_div(-n, d); }

// Whether p - (e, e^2) is in the pixel's diamond.
bool in_diamond(glm::i64vec2 p, glm::i64vec2 pixel) {
  const glm::i64vec2 d = p - kUnit * pixel;
  const std::int64_t distance = std::abs(d.x) + std::abs(d.y);
  return distance < kHalf || (distance == kHalf && d.x > 0);
}

}  // namespace

DiamondSteps diamond_steps(glm::i64vec2 a, glm::i64vec2 b, glm::ivec2 frame) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 29;  // keeps the products below 2^62
  for (const glm::i64vec2 p : {a, b})
    if (p.x < -kFarthest || p.x > kFarthest || p.y < -kFarthest || p.y > kFarthest)
      throw std::invalid_argument(
          fmt::format("a line's end is at {}, {} of 1/256 pixel, expected at most {} from 0", p.x, p.y, kFarthest));
  const glm::i64vec2 d = b - a;
  if (d == glm::i64vec2(0)) return {};

  const int u = std::abs(d.x) >= std::abs(d.y) ? 0 : 1, v = 1 - u;  // major and minor axis
  const bool forward = d[u] > 0;

  // The minor coordinate is a[v] + (256 i - a[u]) d[v] / d[u] at column i's middle, moved by e d[v] / d[u] - e^2 for an
  // x-major line, by -e for a y-major one. Half way between two pixels that decides: up only if x-major and rising.
  const std::int64_t sign = forward ? 1 : -1, n = d[u] * sign, m = d[v] * sign;
  const std::int64_t tie = u == 0 && m > 0 ? 0 : 1;
  const std::int64_t divisor = kUnit * n;
  const auto dividend_at = [&](std::int64_t i) { return (a[v] + kHalf) * n + (kUnit * i - a[u]) * m - tie; };
  const auto pixel_at = [&](std::int64_t i) {
    const std::int64_t j = floor_div(dividend_at(i), divisor);
    return u == 0 ? glm::i64vec2(i, j) : glm::i64vec2(j, i);
  };

  // Columns [first, last] are those whose middle lies between the ends; an end exactly on a middle is moved below it.
  std::int64_t first = ceil_div(forward ? a[u] : b[u], kUnit), last = ceil_div(forward ? b[u] : a[u], kUnit) - 1;
  std::int64_t& start = forward ? first : last;
  std::int64_t& end = forward ? last : first;
  if (in_diamond(a, pixel_at(start - sign))) start -= sign;  // past the middle, and still in the diamond
  if (in_diamond(b, pixel_at(end))) end -= sign;             // past the middle, and not yet out

  first = std::max<std::int64_t>(first, 0);
  last = std::min<std::int64_t>(last, frame[u] - 1);
  if (first > last) return {};
  const std::int64_t from = forward ? first : last;
  const glm::i64vec2 pixel = pixel_at(from);
  return {u, last - first + 1, pixel, sign, dividend_at(from) - pixel[v] * divisor, sign * kUnit * m, divisor};
}

std::vector<glm::ivec2> diamond_exit_line(glm::i64vec2 a, glm::i64vec2 b, glm::ivec2 frame) {
  std::vector<glm::ivec2> pixels;
  visit_diamond_exit_line(a, b, frame, [&](glm::ivec2 p) { pixels.push_back(p); });
  return pixels;
}

}  // namespace plumbline::raster

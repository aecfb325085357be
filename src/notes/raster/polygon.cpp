#include "notes/raster/polygon.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::raster {

namespace {

using Point = glm::i64vec2;

/// Side of the line from a to b on which c lies: 1 left, -1 right, 0 on the line.
int side(Point a, Point b, Point c) {
  const std::int64_t z = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  return (z > 0) - (z < 0);
}

/// True: c, a point on the line through a and b, lies between a and b or on one of them.
bool between(Point a, Point b, Point c) {
  return c.x >= std::min(a.x, b.x) && c.x <= std::max(a.x, b.x) && c.y >= std::min(a.y, b.y) &&
         c.y <= std::max(a.y, b.y);
}

/// True: the interiors of segments ab and cd cross in one point.
bool cross(Point a, Point b, Point c, Point d) {
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

void require_simple(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    for (std::size_t k = 0; k < n; ++k) {
      const bool touches = k != i && k != next && side(p[i], p[next], p[k]) == 0 && between(p[i], p[next], p[k]);
      if (!touches && !cross(p[i], p[next], p[k], p[(k + 1) % n])) continue;
      throw std::invalid_argument(
          fmt::format("expected a polygon that does not cross or touch itself, found edge {} {} {}", i,
                      touches ? "touching corner" : "crossing edge", k));
    }
  }
}

/// Winding of a simple polygon: 1 counter-clockwise, -1 clockwise; that of the lowest of the leftmost corners, which is
/// convex.
int winding(const std::vector<Point>& p) {
  const std::size_t n = p.size();
  std::size_t at = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (p[i].x < p[at].x || (p[i].x == p[at].x && p[i].y < p[at].y)) at = i;
  }
  return side(p[(at + n - 1) % n], p[at], p[(at + 1) % n]);
}

}  // namespace

std::vector<glm::uvec3> decompose(std::span<const glm::ivec2> corners) {
  if (corners.size() < 3) {
    throw std::invalid_argument(fmt::format("expected a polygon of three corners or more, found {}", corners.size()));
  }
  constexpr int kFarthest = 1 << 29;
  const std::vector<Point> p(corners.begin(), corners.end());
  for (const Point& corner : p) {
    for (const std::int64_t v : {corner.x, corner.y}) {
      if (std::abs(v) <= kFarthest) continue;
      throw std::invalid_argument(fmt::format("expected corners within +-{}, found {}", kFarthest, v));
    }
  }
  require_simple(p);
  const int turn = winding(p);

  std::vector<std::uint32_t> left(p.size());
  std::iota(left.begin(), left.end(), 0u);
  const auto is_ear = [&](std::size_t i) {
    const std::size_t n = left.size();
    const std::uint32_t a = left[(i + n - 1) % n], b = left[i], c = left[(i + 1) % n];
    if (side(p[a], p[b], p[c]) != turn) return false;
    return std::none_of(left.begin(), left.end(), [&](std::uint32_t other) {
      if (other == a || other == b || other == c) return false;
      const auto inside = [&](std::uint32_t from, std::uint32_t to) { return side(p[from], p[to], p[other]) != -turn; };
      return inside(a, b) && inside(b, c) && inside(c, a);
    });
  };
  std::vector<glm::uvec3> out;
  while (left.size() > 3) {
    std::size_t ear = 0;
    while (!is_ear(ear)) ++ear;  // ends: every simple polygon of more than three corners has two ears
    const std::size_t n = left.size();
    out.emplace_back(left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  out.emplace_back(left[0], left[1], left[2]);
  return out;
}

}  // namespace plumbline::raster

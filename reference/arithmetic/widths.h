// Widths of a polygon in the window, and of the triangles that renderers may cut it to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/glm.hpp>

namespace plumbline::math {

/// Most corners of a triangle cut by six planes. 9 in exact arithmetic; but where rounding makes a polygon of huge
/// coordinates cross a plane many times, each plane may leave half as many again: 3, 4, 6, 9, 13, 19, 28.
inline constexpr std::size_t kMostCorners = 28;

/// Smallest altitude of a triangle [pixels]: twice its area over its longest side; 0 where all corners coincide.
inline double altitude(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  const double area = std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return longest > 0 ? area / longest : 0;
}

/// Widths of a polygon [pixels].
struct Widths {
  double whole;   ///< the polygon's width: its smallest extent across any direction
  double pieces;  ///< the smallest altitude of any triangle of its corners
  double fat;     ///< the smallest of these altitudes that is above `thin`
};
/// Widths of the polygon of the first `count` corners. `thin`: altitudes up to it do not count for Widths::fat.
inline Widths widths(const std::array<glm::dvec2, kMostCorners>& p, std::size_t count, double thin) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Widths out{kNone, kNone, kNone};
  for (std::size_t a = 0; a < count; ++a) {
    const glm::dvec2 along = p[(a + 1) % count] - p[a];
    if (const double length = glm::length(along); length > 0) {
      double extent = 0;
      for (std::size_t i = 0; i < count; ++i) {
        extent = std::max(extent, std::abs(along.x * (p[i].y - p[a].y) - along.y * (p[i].x - p[a].x)) / length);
      }
      out.whole = std::min(out.whole, extent);
    }
    for (std::size_t b = a + 1; b < count; ++b) {
      for (std::size_t c = b + 1; c < count; ++c) {
        const double height = altitude(p[a], p[b], p[c]);
        out.pieces = std::min(out.pieces, height);
        if (height > thin) out.fat = std::min(out.fat, height);
      }
    }
  }
  if (!std::isfinite(out.whole)) out.whole = 0;
  return out;
}

}  // namespace plumbline::math

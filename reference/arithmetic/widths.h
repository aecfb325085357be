// Widths of a polygon in the window, and of the triangles that renderers may cut it to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

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

/// Distance of a point from a triangle, 0 inside it [pixels].
inline double distance_to_triangle(glm::dvec2 p, const std::array<glm::dvec2, 3>& c) {
  double nearest = std::numeric_limits<double>::infinity();
  int left = 0, right = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 along = c[(i + 1) % 3] - c[i], to = p - c[i];
    const double side = along.x * to.y - along.y * to.x, squared = glm::dot(along, along);
    left += side >= 0, right += side <= 0;
    const double share = squared > 0 ? std::clamp(glm::dot(to, along) / squared, 0.0, 1.0) : 0;
    nearest = std::min(nearest, glm::length(to - share * along));
  }
  const bool has_area = !(left == 3 && right == 3);
  return has_area && (left == 3 || right == 3) ? 0 : nearest;
}

/// Calls visit({a, b, c}) for each three corners of a polygon.
void each_piece(std::span<const glm::dvec2> polygon, auto visit) {
  for (std::size_t a = 0; a < polygon.size(); ++a) {
    for (std::size_t b = a + 1; b < polygon.size(); ++b) {
      for (std::size_t c = b + 1; c < polygon.size(); ++c) visit(std::array{polygon[a], polygon[b], polygon[c]});
    }
  }
}

/// Smallest altitude [pixels] among the triangles of three of a polygon's corners that come within `margin` [pixels] of
/// the point p; infinite where none does.
inline double thinnest_piece(std::span<const glm::dvec2> polygon, glm::dvec2 p, double margin) {
  double out = std::numeric_limits<double>::infinity();
  each_piece(polygon, [&](const std::array<glm::dvec2, 3>& c) {
    const double height = altitude(c[0], c[1], c[2]);
    if (height < out && distance_to_triangle(p, c) <= margin) out = height;
  });
  return out;
}

/// Widths of a polygon [pixels].
struct Widths {
  double whole;   ///< the polygon's width: its smallest extent across any direction
  double pieces;  ///< the smallest altitude of any triangle of its corners
};
inline Widths widths(std::span<const glm::dvec2> p) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  Widths out{kNone, kNone};
  for (std::size_t a = 0; a < p.size(); ++a) {
    const glm::dvec2 along = p[(a + 1) % p.size()] - p[a];
    if (const double length = glm::length(along); length > 0) {
      double extent = 0;
      for (const glm::dvec2& corner : p) {
        extent = std::max(extent, std::abs(along.x * (corner.y - p[a].y) - along.y * (corner.x - p[a].x)) / length);
      }
      out.whole = std::min(out.whole, extent);
    }
  }
  each_piece(
      p, [&](const std::array<glm::dvec2, 3>& c) { out.pieces = std::min(out.pieces, altitude(c[0], c[1], c[2])); });
  if (!std::isfinite(out.whole)) out.whole = 0;
  return out;
}

}  // namespace plumbline::math

// Widths of a polygon in the window, and of the triangles that renderers may cut it to.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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
double distance_to_triangle(glm::dvec2 p, const std::array<glm::dvec2, 3>& c);

/// Calls visit({a, b, c}) for each three corners of a polygon.
void each_piece(std::span<const glm::dvec2> polygon, auto visit) {
  for (std::size_t a = 0; a < polygon.size(); ++a) {
    for (std::size_t b = a + 1; b < polygon.size(); ++b) {
      for (std::size_t c = b + 1; c < polygon.size(); ++c) visit(std::array{polygon[a], polygon[b], polygon[c]});
    }
  }
}

/// Smallest altitude of the triangles of a polygon's corners that come within `margin` of the point [pixels]; infinite
/// where none does.
double thinnest_piece(std::span<const glm::dvec2> polygon, glm::dvec2 p, double margin);

/// Widths of a polygon [pixels].
struct Widths {
  double whole;   ///< the polygon's width: its smallest extent across any direction
  double pieces;  ///< the smallest altitude of any triangle of its corners
};
Widths widths(std::span<const glm::dvec2> p);

}  // namespace plumbline::math

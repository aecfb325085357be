#include "reference/arithmetic/widths.h"

#include <limits>

namespace plumbline::math {

double distance_to_triangle(glm::dvec2 p, const std::array<glm::dvec2, 3>& c) {
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

double thinnest_piece(std::span<const glm::dvec2> polygon, glm::dvec2 p, double margin) {
  double out = std::numeric_limits<double>::infinity();
  each_piece(polygon, [&](const std::array<glm::dvec2, 3>& c) {
    const double height = altitude(c[0], c[1], c[2]);
    if (height < out && distance_to_triangle(p, c) <= margin) out = height;
  });
  return out;
}

Widths widths(std::span<const glm::dvec2> p) {
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

#include "image_order/crossing.h"

#include <algorithm>
#include <cmath>

namespace plumbline::image_order {

namespace {

// a b - c d to within two roundings of the result (Kahan), so that its sign is right, and 0 means 0.
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  const double error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

/// Side on which the ray passes an edge a -> b.
struct Passing {
  double weight;  ///< of the third corner: twice the area of the ray and the edge, seen along the ray
  int side;       ///< the edge is passed on its left (1), on its right (-1); 0 where it is seen as a point
};

// Moved by e in x and by e^2 in y, the ray sees the area (a.x - e)(b.y - e^2) - (a.y - e^2)(b.x - e): where the
// area is 0 the factor of e decides, and where that is 0, the one of e^2.
Passing pass(const Seen& a, const Seen& b) {
  const double weight = difference_of_products(a.x, b.y, a.y, b.x);
  const double decides = weight != 0 ? weight : a.y != b.y ? a.y - b.y : b.x - a.x;
  return {weight, decides > 0 ? 1 : decides < 0 ? -1 : 0};
}

}  // namespace

std::optional<Crossing> crossing(const Ray& ray, const std::array<glm::dvec3, 3>& triangle) {
  const Seen a = seen(ray, triangle[0]), b = seen(ray, triangle[1]), c = seen(ray, triangle[2]);
  const Passing bc = pass(b, c), ca = pass(c, a), ab = pass(a, b);
  const double sum = bc.weight + ca.weight + ab.weight;
  if (bc.side != ca.side || ca.side != ab.side || sum == 0) return std::nullopt;
  const double there = (bc.weight * a.along + ca.weight * b.along + ab.weight * c.along) / sum;
  const auto [nearest, farthest] = std::minmax({a.along, b.along, c.along});  // rounding must not leave this range
  return Crossing{std::clamp(there, nearest, farthest), sum > 0};
}

}  // namespace plumbline::image_order

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

/// Whether the ray passes an edge a -> b on its left (1) or its right (-1).
struct Passing {
  double weight;  ///< of the third corner: twice the area that the ray and the edge span
  int side;       ///< 0 where the edge is seen as a point, or runs into the eye
};

Passing pass(const Ray& ray, const Seen& a, const Seen& b) {
  const double weight = difference_of_products(a.x, b.y, a.y, b.x);
  // Moved to the right by e, and up by e^2, a point is seen e (e^2) times its distance further left (down): in
  // (a.x - e ka)(b.y - e^2 kb) - (a.y - e^2 ka)(b.x - e kb), the factors of e and e^2.
  const double ka = ray.parallel ? 1 : a.along, kb = ray.parallel ? 1 : b.along;
  double decides = weight;
  if (decides == 0) decides = difference_of_products(a.y, kb, ka, b.y);
  if (decides == 0) decides = difference_of_products(ka, b.x, a.x, kb);
  return {weight, decides > 0 ? 1 : decides < 0 ? -1 : 0};
}

}  // namespace

std::optional<Crossing> crossing(const Ray& ray, const std::array<glm::dvec3, 3>& triangle) {
  const Seen a = seen(ray, triangle[0]), b = seen(ray, triangle[1]), c = seen(ray, triangle[2]);
  const Passing bc = pass(ray, b, c), ca = pass(ray, c, a), ab = pass(ray, a, b);
  const double sum = bc.weight + ca.weight + ab.weight;
  if (bc.side != ca.side || ca.side != ab.side || sum == 0) return std::nullopt;
  const double there = (bc.weight * a.along + ca.weight * b.along + ab.weight * c.along) / sum;
  const auto [nearest, farthest] = std::minmax({a.along, b.along, c.along});  // between them, whatever was rounded
  return Crossing{std::clamp(there, nearest, farthest), sum > 0};
}

}  // namespace plumbline::image_order

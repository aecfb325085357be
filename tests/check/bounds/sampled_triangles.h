// Samples of random triangles, at which a loop's depths are held to their bounds.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/glm.hpp>

#include "capture/float_depth.h"

namespace plumbline::test {

/// A pixel of the frame whose centre lies in the triangle.
struct TriangleSample {
  glm::dvec2 frame;  ///< its size [pixels]
  WindowCorners corners;
  int x, y;
  glm::dvec2 p;           ///< the centre [pixels]
  double area;            ///< twice the triangle's, signed [pixels^2]
  double b1, b2;          ///< shares of corners 1 and 2
  double least_share, z;  ///< the smallest of the three; the depth, in double
};

/// Visits samples of 300 triangles, whose corners are floats and lie in `reach` times the frame's sides. `keeps`: may
/// alter the corners of triangle n; false: the triangle is left out.
template <class Keeps, class Visit>
void each_sample(unsigned seed, double reach, Keeps keeps, Visit visit) {
  std::mt19937 random(seed);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  for (int n = 0; n < 300; ++n) {
    TriangleSample at{};
    at.frame = glm::floor(glm::dvec2(std::exp2(in(3, 11)), std::exp2(in(3, 11))));
    for (glm::dvec3& corner : at.corners) {
      const auto along = [&](double side) { return side * (0.5 + reach * in(-0.5, 0.5)); };
      corner = glm::dvec3(glm::vec3(along(at.frame.x), along(at.frame.y), in(0, 1)));
    }
    if (!keeps(at.corners, n)) continue;
    const glm::dvec2 a(at.corners[0]), e1 = glm::dvec2(at.corners[1]) - a, e2 = glm::dvec2(at.corners[2]) - a;
    at.area = e1.x * e2.y - e2.x * e1.y;
    for (int k = 0; k < 64; ++k) {
      const double s = in(0.02, 0.9), t = in(0.02, 0.96 - s);
      const glm::dvec2 inside = glm::floor(a + s * e1 + t * e2), q = inside + 0.5 - a;
      at.p = inside + 0.5;
      at.b1 = (q.x * e2.y - e2.x * q.y) / at.area, at.b2 = (e1.x * q.y - q.x * e1.y) / at.area;
      at.least_share = std::min({at.b1, at.b2, 1 - at.b1 - at.b2});
      const bool is_seen = inside.x >= 0 && inside.y >= 0 && inside.x < at.frame.x && inside.y < at.frame.y;
      if (!is_seen || at.least_share < 0) continue;
      const double z0 = at.corners[0].z;
      at.z = z0 + at.b1 * (at.corners[1].z - z0) + at.b2 * (at.corners[2].z - z0);
      at.x = static_cast<int>(inside.x), at.y = static_cast<int>(inside.y);
      visit(at);
    }
  }
}

/// Twice the triangle's area [pixels^2].
inline double twice_area(const WindowCorners& c) {
  const glm::dvec2 e1 = glm::dvec2(c[1] - c[0]), e2 = glm::dvec2(c[2] - c[0]);
  return std::abs(e1.x * e2.y - e2.x * e1.y);
}

}  // namespace plumbline::test

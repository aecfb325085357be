// Depths that a scan line's loop adds up in float, from the lowest corner along the long edge and from there along x.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "capture/float_depth.h"

namespace plumbline {
namespace {

// Depth at the centre of pixel (x, y) of a triangle that covers it.
float stepped(const WindowCorners& corners, int x, int y) {
  std::array<glm::vec3, 3> v = {glm::vec3(corners[0]), glm::vec3(corners[1]), glm::vec3(corners[2])};
  std::ranges::sort(v, {}, &glm::vec3::y);
  const glm::vec3 e1 = v[1] - v[0], e2 = v[2] - v[0];
  const float dz_dx = (e1.z * e2.y - e2.z * e1.y) / (e1.x * e2.y - e2.x * e1.y);
  const float dx_dy = e2.x / e2.y, dz_dy = e2.z / e2.y;
  const float first = std::ceil(v[0].y - 0.5f) + 0.5f;
  float edge_x = v[0].x + dx_dy * (first - v[0].y), z = v[0].z + dz_dy * (first - v[0].y);
  for (float row = first; row < static_cast<float>(y) + 0.5f; ++row) edge_x += dx_dy, z += dz_dy;
  const float at = static_cast<float>(x) + 0.5f;
  float column = at < edge_x ? std::floor(edge_x - 0.5f) + 0.5f : std::ceil(edge_x - 0.5f) + 0.5f;
  z += dz_dx * (column - edge_x);
  for (; column < at; ++column) z += dz_dx;
  for (; column > at; --column) z -= dz_dx;
  return z;
}

TEST(SteppedDepths, AreWithinTheirBoundAndBeyondThatOfOneProduct) {
  using enum Conventions::DepthArithmetic;
  std::mt19937 random(11);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  double most = 0, most_of_product = 0;
  for (int n = 0; n < 300; ++n) {
    const double width = std::exp2(in(3, 11)), height = std::exp2(in(3, 11));
    WindowCorners corners;
    for (glm::dvec3& corner : corners) {
      corner = {in(0, width), in(0, height), in(0, 1)};
      corner = glm::dvec3(glm::vec3(corner));
    }
    const glm::dvec2 a(corners[0]), e1 = glm::dvec2(corners[1]) - a, e2 = glm::dvec2(corners[2]) - a;
    const double area = e1.x * e2.y - e2.x * e1.y;
    if (std::abs(area) < 64) continue;
    for (int k = 0; k < 64; ++k) {
      const double s = in(0.02, 0.9), t = in(0.02, 0.96 - s);
      const glm::dvec2 inside = a + s * e1 + t * e2;
      const int x = static_cast<int>(inside.x), y = static_cast<int>(inside.y);
      const glm::dvec2 p(x + 0.5, y + 0.5), q = p - a;
      const double b1 = (q.x * e2.y - e2.x * q.y) / area, b2 = (e1.x * q.y - q.x * e1.y) / area;
      if (std::min({b1, b2, 1 - b1 - b2}) < 0.01) continue;
      const double z = corners[0].z + b1 * (corners[1].z - corners[0].z) + b2 * (corners[2].z - corners[0].z),
                   off = std::abs(static_cast<double>(stepped(corners, x, y)) - z);
      most = std::max(most, off / depth_error(in_float_stepped, corners, p));
      most_of_product = std::max(most_of_product, off / depth_error(in_float, corners, p));
    }
  }
  std::printf("%.3f of the bound, %.3f of that of in_float\n", most, most_of_product);
  EXPECT_LE(most, 1);
  EXPECT_GE(most, 0.05) << "loose";
  EXPECT_GT(most_of_product, 1.5);
}

}  // namespace
}  // namespace plumbline

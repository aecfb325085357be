// Depths that follow from 1/w interpolated in float, or from a buffer of w; and depths that a loop adds up from planes
// at the window's origin.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "capture/float_depth.h"
#include "tests/check/bounds/sampled_triangles.h"

namespace plumbline {
namespace {

using Shares = std::array<float, 3>;

// Shares of the corners at a pixel's centre, by edge functions in float.
Shares shares_in_float(const WindowCorners& corners, int x, int y) {
  const std::array<glm::vec2, 3> v = {glm::vec2(corners[0]), glm::vec2(corners[1]), glm::vec2(corners[2])};
  const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
  const auto edge = [](glm::vec2 from, glm::vec2 to, glm::vec2 at) {
    return (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x);
  };
  const float area = edge(v[0], v[1], v[2]);
  return {edge(v[1], v[2], p) / area, edge(v[2], v[0], p) / area, edge(v[0], v[1], p) / area};
}

struct OfBounds {
  double of_bound = 0, of_window_z = 0;
};

// Largest ratios of errors to bounds, of a projection whose far plane lies `depth` times the near plane's distance
// behind it.
OfBounds of_inv_w(double depth, bool keeps_w) {
  using enum Conventions::DepthArithmetic;
  const double c = (1 + depth) / depth, k = c;  // window z = c - k / w, the near plane at w = 1
  OfBounds out;
  const auto keeps = [](const WindowCorners& corners, int) { return test::twice_area(corners) >= 64; };
  test::each_sample(23, 1, keeps, [&](const test::TriangleSample& at) {
    if (at.least_share < 0.01) return;
    const Shares b = shares_in_float(at.corners, at.x, at.y);
    float inv_w = 0;
    for (std::size_t i = 0; i < 3; ++i) inv_w += b[i] * static_cast<float>((c - at.corners[i].z) / k);
    const float left = keeps_w ? static_cast<float>(k) / (1 / inv_w) : static_cast<float>(k) * inv_w;
    const double off = std::abs(static_cast<double>(static_cast<float>(c) - left) - at.z);
    out.of_bound = std::max(out.of_bound, off / depth_error(in_float, at.corners, at.p, at.frame, c));
    out.of_window_z = std::max(out.of_window_z, off / depth_error(in_float, at.corners, at.p, at.frame));
  });
  std::printf("%.3f of the bound, %.3f of that of window z\n", out.of_bound, out.of_window_z);
  return out;
}

TEST(DepthOfInvW, IsWithinItsBoundAndBeyondThatOfWindowZ) {
  for (const bool keeps_w : {false, true}) {
    for (const double depth : {0.002, 0.5, 1000.0}) {
      const OfBounds of = of_inv_w(depth, keeps_w);
      EXPECT_LE(of.of_bound, 1) << depth;
      EXPECT_GE(of.of_bound, 0.05) << depth << ": loose";
      if (depth < 0.01) {
        EXPECT_GT(of.of_window_z, 10);
      }
    }
  }
}

// Without perspective the distance before the eye is interpolated: a near plane at 100, a far one at 101.
TEST(DepthOfInvW, CountsDistancesWithoutPerspective) {
  using enum Conventions::DepthArithmetic;
  const WindowCorners corners = {{{1, 1, 0.25}, {30, 2, 0.5}, {7, 28, 0.75}}};
  const glm::dvec2 p(10.5, 9.5), frame(32);
  EXPECT_GT(depth_error(in_float, corners, p, frame, -100), 50 * depth_error(in_float, corners, p, frame));
  EXPECT_GE(depth_error(in_float, corners, p, frame, 0.5), depth_error(in_float, corners, p, frame));
  EXPECT_EQ(depth_error(in_double, corners, p, frame, -100), error_of_inv_w(corners, -100)) << "a buffer of floats";
  EXPECT_EQ(error_of_inv_w(corners, -100), 0x1p-24 * (100 + 4 * 100.75));
  EXPECT_EQ(error_of_inv_w(corners, {}), 0);
}

TEST(DepthOfInvW, OfPiecesIsNoLessThanThatOfAnyTriangle) {
  using enum Conventions::DepthArithmetic;
  const auto keeps = [](const WindowCorners& corners, int) { return test::twice_area(corners) >= 64; };
  test::each_sample(29, 1, keeps, [&](const test::TriangleSample& at) {
    const glm::dvec3 normal = glm::cross(at.corners[1] - at.corners[0], at.corners[2] - at.corners[0]);
    double longest = 0;
    for (std::size_t i = 0; i < 3; ++i)
      longest = std::max(longest, glm::distance(glm::dvec2(at.corners[i]), glm::dvec2(at.corners[(i + 1) % 3])));
    const double slope = glm::length(glm::dvec2(normal)) / std::abs(normal.z), altitude = std::abs(at.area) / longest;
    for (const auto arithmetic : {in_float, in_float_stepped, in_float_from_origin, in_float_from_origin_stepped}) {
      for (const std::optional<double> c : {std::optional(501.0), std::optional(1.0), std::optional(-3.0), {}})
        EXPECT_LE(depth_error(arithmetic, at.corners, at.p, at.frame, c),
                  depth_error_of_pieces(arithmetic, altitude, slope, at.frame, at.frame, c));
    }
  });
}

// A row begins with a plane's value from the window's origin; steps of dz/dx follow.
TEST(DepthsFromTheOrigin, SteppedAreWithinTheirBoundAndBeyondThatOfOneProduct) {
  using enum Conventions::DepthArithmetic;
  double of_bound = 0, of_product = 0;
  const auto keeps = [](WindowCorners& corners, int) {  // nearly level, so that steps lose most
    for (glm::dvec3& corner : corners) corner.z = 0.75 + corner.z / 4096;
    return test::twice_area(corners) >= 64;
  };
  test::each_sample(31, 1, keeps, [&](const test::TriangleSample& at) {
    if (at.least_share < 0.01) return;
    const std::array<glm::vec3, 3> v = {glm::vec3(at.corners[0]), glm::vec3(at.corners[1]), glm::vec3(at.corners[2])};
    const glm::vec3 e1 = v[1] - v[0], e2 = v[2] - v[0];
    const float area = e1.x * e2.y - e2.x * e1.y, dz_dx = (e1.z * e2.y - e2.z * e1.y) / area,
                dz_dy = (e1.x * e2.z - e2.x * e1.z) / area, z_origin = v[0].z - dz_dx * v[0].x - dz_dy * v[0].y;
    const int first = std::max(static_cast<int>(std::min({v[0].x, v[1].x, v[2].x})), 0);
    float z = z_origin + dz_dx * (static_cast<float>(first) + 0.5f) + dz_dy * (static_cast<float>(at.y) + 0.5f);
    for (int x = first; x < at.x; ++x) z += dz_dx;
    double exact = 0;
    const std::array b = {1 - at.b1 - at.b2, at.b1, at.b2};
    for (std::size_t i = 0; i < 3; ++i) exact += b[i] * double{v[i].z};
    WindowCorners corners = at.corners;
    for (std::size_t i = 0; i < 3; ++i) corners[i].z = v[i].z;
    const double off = std::abs(double{z} - exact);
    of_bound = std::max(of_bound, off / depth_error(in_float_from_origin_stepped, corners, at.p, at.frame));
    of_product = std::max(of_product, off / depth_error(in_float, corners, at.p, at.frame));
  });
  std::printf("%.3f of the bound, %.3f of that of in_float\n", of_bound, of_product);
  EXPECT_LE(of_bound, 1);
  EXPECT_GE(of_bound, 0.02) << "loose";
  EXPECT_GT(of_product, 1.5);
}

}  // namespace
}  // namespace plumbline

// Depths that a scan line's loop adds up in float, from the lowest corner along the long edge and from there along x.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "capture/float_depth.h"
#include "tests/check/bounds/sampled_triangles.h"

namespace plumbline {
namespace {

// Depth at the centre of pixel (x, y), in the frame, of a triangle that covers it. The loop begins in the frame's first
// row and column.
float stepped(const WindowCorners& corners, int x, int y, glm::vec2 frame) {
  std::array<glm::vec3, 3> v = {glm::vec3(corners[0]), glm::vec3(corners[1]), glm::vec3(corners[2])};
  std::ranges::sort(v, {}, &glm::vec3::y);
  const glm::vec3 e1 = v[1] - v[0], e2 = v[2] - v[0];
  const float dz_dx = (e1.z * e2.y - e2.z * e1.y) / (e1.x * e2.y - e2.x * e1.y);
  const float dx_dy = e2.x / e2.y, dz_dy = e2.z / e2.y;
  const float first = std::max(std::ceil(v[0].y - 0.5f), 0.0f) + 0.5f;
  float edge_x = v[0].x + dx_dy * (first - v[0].y), z = v[0].z + dz_dy * (first - v[0].y);
  for (float row = first; row < static_cast<float>(y) + 0.5f; ++row) edge_x += dx_dy, z += dz_dy;
  const float at = static_cast<float>(x) + 0.5f;
  float column = at < edge_x ? std::floor(edge_x - 0.5f) + 0.5f : std::ceil(edge_x - 0.5f) + 0.5f;
  column = std::clamp(column, 0.5f, frame.x - 0.5f);
  z += dz_dx * (column - edge_x);
  for (; column < at; ++column) z += dz_dx;
  for (; column > at; --column) z -= dz_dx;
  return z;
}

// Largest ratios of errors to bounds, of triangles whose corners lie in `reach` times the frame's sides.
struct Ratios {
  double of_bound = 0, of_product = 0;
};
Ratios largest_ratios(double reach) {
  using enum Conventions::DepthArithmetic;
  Ratios out;
  const auto keeps = [](const WindowCorners& corners, int) { return test::twice_area(corners) >= 64; };
  test::each_sample(11, reach, keeps, [&](const test::TriangleSample& at) {
    if (at.least_share < 0.01) return;
    const double off = std::abs(static_cast<double>(stepped(at.corners, at.x, at.y, at.frame)) - at.z);
    out.of_bound = std::max(out.of_bound, off / depth_error(in_float_stepped, at.corners, at.p, at.frame));
    out.of_product = std::max(out.of_product, off / depth_error(in_float, at.corners, at.p, at.frame));
  });
  std::printf("%.3f of the bound, %.3f of that of in_float\n", out.of_bound, out.of_product);
  return out;
}

TEST(SteppedDepths, AreWithinTheirBoundAndBeyondThatOfOneProduct) {
  const Ratios of = largest_ratios(1);
  EXPECT_LE(of.of_bound, 1);
  EXPECT_GE(of.of_bound, 0.05) << "loose";
  EXPECT_GT(of.of_product, 1.5);
}

// Rows and columns beyond the frame are left out by products.
TEST(SteppedDepths, AreWithinTheirBoundWhereCornersLieBeyondTheFrame) {
  for (const double reach : {4, 40}) {
    const Ratios of = largest_ratios(reach);
    EXPECT_LE(of.of_bound, 1);
    EXPECT_GE(of.of_bound, 0.01) << "loose";
  }
}

// A corner 4,000 rows below a frame of 100: the loop takes 100 steps at most.
TEST(SteppedDepths, StepInTheFrameAlone) {
  const WindowCorners corners = {{{0, -4000, 0}, {100, -4000, 0}, {50, 100, 1}}};
  const glm::dvec2 p(50.5, 50.5), frame(100, 100);
  constexpr auto kStepped = Conventions::DepthArithmetic::in_float_stepped;
  EXPECT_LT(10 * error_by_steps(kStepped, corners, p, frame), error_by_steps(kStepped, corners, p, kNoSides));
  const glm::dvec2 extent(4000, 4000);
  const auto of_pieces = [&](glm::dvec2 sides) { return depth_error_of_pieces(kStepped, 2000, 1e-5, extent, sides); };
  EXPECT_LT(10 * of_pieces(frame), of_pieces(kNoSides));
}

}  // namespace
}  // namespace plumbline

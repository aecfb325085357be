// What the notes leave open about clip space: GAMES101's (001) w is negative, TinyRenderer's (002) z leaves its
// viewport.
#include <algorithm>

#include <gtest/gtest.h>

#include "transforms/projection.h"
#include "transforms/transform.h"
#include "transforms/viewport.h"

namespace plumbline::transforms {
namespace {

constexpr double kRightAngle = 1.5707963267948966;

// With n and f negative, M_persp->ortho gives w = z: nothing that is seen is inside -w <= x, y, z <= w. The division
// hides it; clipping needs the matrix times -1, which is the same projection.
TEST(NotesProjection, Games101sWIsNegativeForWhatIsSeen) {
  const glm::dmat4 m = games101::perspective({kRightAngle, 1}, -1, -3);
  const glm::dvec4 p = m * glm::dvec4(1, -0.5, -2, 1);
  EXPECT_EQ(p.w, -2);
  EXPECT_NEAR(p.x / p.w, 0.5, 1e-15);
  EXPECT_NEAR(p.y / p.w, -0.25, 1e-15);
  EXPECT_NEAR(p.z / p.w, -0.5, 1e-15);
  EXPECT_FALSE(-p.w <= p.x && p.x <= p.w);
  const glm::dvec4 q = -m * glm::dvec4(1, -0.5, -2, 1);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(-q.w <= q[i] && q[i] <= q.w);
  // Then it is GL's with near and far turned round: z of 1 at n for one of -1.
  const glm::dmat4 gl = scaling({1, 1, -1}) * gl::perspective({kRightAngle, 1}, 1, 3);
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(-m[i / 4][i % 4], gl[i / 4][i % 4], 1e-15);
}

// 002's viewport takes z from [-1, 1] to [0, depth]; its projection gives z/(1 - z/c). From z = c/(c + 1) on, the
// notes' clamp makes all of it the nearest depth there is.
TEST(NotesProjection, TinyRenderersNearestTenthIsClampedToOneDepth) {
  constexpr double kEye = 4;
  const glm::dmat4 m = tinyrenderer::viewport(0, 0, 800, 800, 255) * tinyrenderer::projection(kEye);
  const auto z_win = [&](double z) {
    const glm::dvec4 q = m * glm::dvec4(0, 0, z, 1);
    return q.z / q.w;
  };
  const auto code = [&](double z) { return std::max(0, std::min(255, static_cast<int>(z_win(z) + 0.5))); };
  EXPECT_NEAR(z_win(0.8), 255, 1e-12);
  EXPECT_NEAR(z_win(2), 637.5, 1e-12) << "what the cube's z in [-1, 1] should have kept from happening";
  EXPECT_NEAR(z_win(-1), 25.5, 1e-12);
  EXPECT_NEAR(z_win(-1e9), -382.5, 1e-5) << "NDC z of -c";
  EXPECT_EQ(code(-4.0 / 3 - 0.01), 0) << "behind z = -c/(c - 1) all is 0";
  // Of a model in [-1, 1]^3 the tenth that is nearest to the eye has one code: 42 are lost.
  EXPECT_EQ(code(0.8), 255);
  EXPECT_EQ(code(1), 255);
  EXPECT_NEAR(z_win(1) - z_win(0.8), 42.5, 1e-12);
}

}  // namespace
}  // namespace plumbline::transforms

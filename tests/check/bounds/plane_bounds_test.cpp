// Bounds of colours that a renderer interpolates by planes of c/w and of 1/w.
#include <gtest/gtest.h>

#include <cmath>

#include "check/bounds/bounds.h"

namespace plumbline::check {
namespace {

// The colour is a quotient: an error of 1/w moves it by more than to first order, and without a limit near 0.
TEST(PlaneBounds, AreOfTheQuotientNotOfItsSlope) {
  constexpr double kU = kFloatRounding;
  const PlaneBounds plane{.depth = 1, .color = Vec4<double>(2), .inv_w = 4};
  EXPECT_DOUBLE_EQ(plane.color_error(1).r, kU * 2 / (1 - 4 * kU));
  EXPECT_DOUBLE_EQ(plane.color_error(0.125 / kU).r, 0.125 * 2 / 0.5);
  for (const double factor : {0.25 / kU, 1.0 / kU}) EXPECT_TRUE(std::isinf(plane.color_error(factor).r)) << factor;
}

}  // namespace
}  // namespace plumbline::check

// Outcomes of a fragment's tests, for judges.
#include "capture/fragment_outcomes.h"

#include <gtest/gtest.h>

#include <limits>

namespace plumbline {
namespace {

TEST(AlphaOutcomes, AreOpenWhereTheIntervalHoldsAStepOfTheFormat) {
  const AlphaTest test{CompareFunc::greater, 100.0f / 255};
  const auto open = [&](ColorFormat format, double lo, double hi) {
    const Outcomes o = alpha_outcomes(test, format, lo, hi);
    return o.may_pass && o.may_fail;
  };
  EXPECT_TRUE(open(ColorFormat::rgba8, 100.4 / 255, 100.6 / 255));
  EXPECT_FALSE(open(ColorFormat::rgba8, 99.6 / 255, 100.4 / 255)) << "one code";
  EXPECT_TRUE(open(ColorFormat::rgba32f, 99.6 / 255, 100.4 / 255));
  EXPECT_FALSE(alpha_outcomes(test, ColorFormat::rgba8, 100.4 / 255, 100.4 / 255).may_pass);
  EXPECT_TRUE(alpha_outcomes(test, ColorFormat::rgba32f, 100.4 / 255, 100.4 / 255).may_pass);
}

TEST(AlphaOutcomes, AreOpenOfAnUnknownNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const CompareFunc func : {CompareFunc::less, CompareFunc::equal, CompareFunc::not_equal}) {
    const Outcomes o = alpha_outcomes({func, 0.5f}, ColorFormat::rgba32f, nan, nan);
    EXPECT_TRUE(o.may_pass && o.may_fail);
  }
  EXPECT_FALSE(alpha_outcomes({CompareFunc::never, 0.5f}, ColorFormat::rgba32f, nan, nan).may_pass);
  EXPECT_FALSE(alpha_outcomes({CompareFunc::always, 0.5f}, ColorFormat::rgba32f, nan, nan).may_fail);
}

TEST(PassesAllOver, TheEndsOfTheRangeOfDepths) {
  EXPECT_TRUE(passes_all_over(DepthFunc::less_equal, 1));
  for (const DepthFormat format : {DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f})
    EXPECT_FALSE(passes_all_over(DepthFunc::less_equal, 1 - depth_step(format, 1))) << "a step before the end";
  EXPECT_FALSE(passes_all_over(DepthFunc::less_equal, 0));
  EXPECT_TRUE(passes_all_over(DepthFunc::greater_equal, 0));
  EXPECT_FALSE(passes_all_over(DepthFunc::greater_equal, 1));
  for (const DepthFunc func : {DepthFunc::less, DepthFunc::equal, DepthFunc::greater, DepthFunc::not_equal})
    EXPECT_FALSE(passes_all_over(func, 1) || passes_all_over(func, 0));
}

}  // namespace
}  // namespace plumbline

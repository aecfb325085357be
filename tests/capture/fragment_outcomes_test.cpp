// Outcomes of a fragment's tests, for judges.
#include "capture/fragment_outcomes.h"

#include <gtest/gtest.h>

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

TEST(PassesAllOver, TheEndsOfFormatsWithCodes) {
  for (const DepthFormat format : {DepthFormat::z16, DepthFormat::z24}) {
    EXPECT_TRUE(passes_all_over(DepthFunc::less_equal, format, 1));
    EXPECT_FALSE(passes_all_over(DepthFunc::less_equal, format, 1 - depth_step(format, 1))) << "a code before the end";
    EXPECT_FALSE(passes_all_over(DepthFunc::less_equal, format, 0));
    EXPECT_TRUE(passes_all_over(DepthFunc::greater_equal, format, 0));
    EXPECT_FALSE(passes_all_over(DepthFunc::greater_equal, format, 1));
    for (const DepthFunc func : {DepthFunc::less, DepthFunc::equal, DepthFunc::greater, DepthFunc::not_equal})
      EXPECT_FALSE(passes_all_over(func, format, 1) || passes_all_over(func, format, 0));
  }
  EXPECT_FALSE(passes_all_over(DepthFunc::less_equal, DepthFormat::z32f, 1)) << "floats may be beyond 1";
}

}  // namespace
}  // namespace plumbline

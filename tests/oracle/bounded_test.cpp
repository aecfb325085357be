// Bounded numbers: results of values within the bounds lie within the result's bound, which is no wider than the
// results at the ends.
#include "reference/arithmetic/bounded.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "reference/arithmetic/fog.h"
#include "reference/arithmetic/texture.h"

namespace plumbline::math {
namespace {

// Least and greatest value of `f` at the ends of three numbers.
std::pair<double, double> at_ends(const Bounded (&in)[3], const std::function<double(double, double, double)>& f) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (int ends = 0; ends < 8; ++ends) {
    const auto end = [&](int i) { return in[i].value + ((ends >> i & 1) != 0 ? 1 : -1) * in[i].error; };
    const double v = f(end(0), end(1), end(2));
    least = std::min(least, v), most = std::max(most, v);
  }
  return {least, most};
}

TEST(BoundedNumbers, HoldWhatTheEndsComeToAndNoMore) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> value(-2, 2), error(0, 0.1);
  const Rounding by{{0}};
  for (int i = 0; i < 1000; ++i) {
    const Bounded in[3] = {
        {value(random), error(random)}, {value(random), error(random)}, {value(random), error(random)}};
    const auto expect = [&](const char* what, Bounded out, const auto& f) {
      const auto [least, most] = at_ends(in, f);
      const double reached = std::max(most - out.value, out.value - least);
      EXPECT_LE(reached, out.error * (1 + 1e-12)) << what;
      EXPECT_GE(reached, out.error * (1 - 1e-12)) << what;
    };
    const auto product = [](double a, double b, double) { return Exactly::product(a, b); };
    expect("product", by.product(in[0], in[1]), product);
    const auto mixed = [](double a, double b, double k) { return Exactly::mixed(a, b, k); };
    const Bounded mix = by.mixed(in[0], in[1], in[2]);
    const auto [least, most] = at_ends(in, mixed);
    EXPECT_DOUBLE_EQ(mix.value, mixed(in[0].value, in[1].value, in[2].value));
    const double reached = std::max(most - mix.value, mix.value - least);
    EXPECT_LE(reached, mix.error * (1 + 1e-12));
    // Terms of second order, (db - da) dk, are counted with either sign.
    EXPECT_GE(reached, mix.error - 2 * (in[0].error + in[1].error) * in[2].error - 1e-12);
    const Bounded sum = by.clamped_sum(in[0], in[1]);
    EXPECT_EQ(sum.value, Exactly::clamped_sum(in[0].value, in[1].value));
    EXPECT_EQ(sum.error, in[0].error + in[1].error);
  }
}

TEST(BoundedNumbers, HoldMixesInFloatByEitherForm) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0, 1);
  const Rounding by{{3}};
  for (int i = 0; i < 20000; ++i) {
    const float a = unit(random), b = unit(random), k = i % 8 == 0 ? 1 : unit(random);
    const Bounded exact = by.mixed({a, 0}, {b, 0}, {k, 0});
    ASSERT_LE(std::abs(static_cast<double>(a + (b - a) * k) - exact.value), exact.error) << a << ' ' << b << ' ' << k;
    ASSERT_LE(std::abs(static_cast<double>(a * (1 - k) + b * k) - exact.value), exact.error);
  }
}

TEST(BoundedNumbers, CountEachResultsRounding) {
  const Rounding by{{3}};
  const double u3 = 3 * kFloatRounding;
  EXPECT_NEAR(by.product({2, 0}, {-4, 0}).error, 8 * u3, 1e-20);
  EXPECT_NEAR(by.mixed({2, 0}, {-4, 0}, {0.25, 0}).error, 3.5 * u3, 1e-20) << "2 and -1.5";
  EXPECT_NEAR(by.clamped_sum({2, 0}, {-4, 0}).error, 2 * u3, 1e-20);
  EXPECT_EQ(by.clamped_sum({2, 0}, {-2, 0}).error, 0) << "nothing is rounded";
  EXPECT_GT(by.product({0x1p-100, 0}, {0x1p-30, 0}).error, kGradualUnderflow);
}

TEST(BoundedNumbers, FogIsWithinItsBound) {
  for (const Fog::Mode mode : {Fog::Mode::linear, Fog::Mode::exp, Fog::Mode::exp2}) {
    Fog fog;
    fog.mode = mode;
    fog.density = 0.3f;
    fog.start = 1;
    fog.end = 9;
    for (double z = -8; z < -1.1; z += 0.37) {
      const double dz = 0.01;
      const Bounded f = fog_factor(fog, {z, dz}, {0});
      const double apart = std::max(std::abs(fog_factor(fog, {z + dz, 0}, {0}).value - f.value),
                                    std::abs(fog_factor(fog, {z - dz, 0}, {0}).value - f.value));
      EXPECT_LE(apart, f.error * (1 + 1e-12)) << z;
      // Of second order in d dz, d the density: |f''/f'| and the slope's growth up to the nearest distance are each
      // below 5 d where d |z| < 2.5.
      EXPECT_GE(apart, f.error * (1 - 10 * static_cast<double>(fog.density) * dz)) << z;
    }
  }
}

// At t = 0, the border of two rows, the row is known where t is; at s = 1/4, the middle of a texel, the column is.
TEST(BoundedTexels, AreKnownOnABorderWhoseCoordinateIsKnown) {
  Texture texture;
  texture.sampler.min = MinFilter::nearest, texture.sampler.mag = MagFilter::nearest;
  texture.levels.resize(1);
  texture.levels[0].width = texture.levels[0].height = 2;
  texture.levels[0].texels = {glm::vec4(0), glm::vec4(0.25f), glm::vec4(0.5f), glm::vec4(1)};
  const auto bound = [&](glm::dvec2 of_st) {
    const BoundedPlace place{.st = {0.25, 0}, .bound = of_st, .lambda = -1, .lambda_lo = -1, .lambda_hi = -1};
    return bounded_textured_color(texture, DrawTexture{}, {glm::dvec4(1), 0}, place).bound;
  };
  EXPECT_LT(bound({0, 0}), 1e-5);
  EXPECT_LT(bound({0.2, 0}), 1e-5);
  EXPECT_FALSE(std::isfinite(bound({0.3, 0}))) << "another column";
  EXPECT_FALSE(std::isfinite(bound({0, 1e-9}))) << "another row";
}

}  // namespace
}  // namespace plumbline::math

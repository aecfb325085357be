// The words that the kernels are written in, for one pixel at a time.
#include "kernels/lanes.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace plumbline::pipeline {
namespace {

TEST(PipelineLanes, RoundEvenInFloat) {
  // Every half, and its neighbours, near 0; then samples up to 2^22. nearbyint rounds half to even by default.
  for (int k = -2000; k <= 2000; ++k) {
    const float half = static_cast<float>(k) + 0.5f;
    for (float v : {half, std::nextafter(half, 1e9f), std::nextafter(half, -1e9f), static_cast<float>(k)}) {
      ASSERT_EQ(round_even(v), std::nearbyint(v)) << v;
    }
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<float> number(-4194304, 4194304);
  for (int i = 0; i < 20000; ++i) {
    const float v = number(random), half = std::floor(v) + 0.5f;
    ASSERT_EQ(round_even(v), std::nearbyint(v)) << v;
    if (std::abs(half) < 4194304) {
      ASSERT_EQ(round_even(half), std::nearbyint(half)) << half;
    }
  }
  EXPECT_EQ(round_even(4194303.5f), 4194304.0f);
  EXPECT_EQ(round_even(-4194303.5f), -4194304.0f);
  EXPECT_EQ(round_even(4194302.5f), 4194302.0f);
}

TEST(PipelineLanes, RoundEvenInDouble) {
  std::mt19937_64 random(2);
  for (int bits = 0; bits <= 51; ++bits) {
    std::uniform_real_distribution<double> number(-std::ldexp(1.0, bits), std::ldexp(1.0, bits));
    for (int i = 0; i < 400; ++i) {
      const double v = number(random), half = std::floor(v) + 0.5;
      ASSERT_EQ(round_even(v), std::nearbyint(v)) << v;
      if (std::abs(half) < std::ldexp(1.0, 51)) {
        ASSERT_EQ(round_even(half), std::nearbyint(half)) << half;
      }
    }
  }
  EXPECT_EQ(round_even(2251799813685246.5), 2251799813685246.0);
  EXPECT_EQ(round_even(2251799813685247.5), 2251799813685248.0);
  EXPECT_EQ(round_even(std::nextafter(16777214.5, 0.0)), 16777214.0);
  EXPECT_EQ(round_even(std::nextafter(16777214.5, 1e9)), 16777215.0);
}

template <class T>
void expect_clamped() {
  const T infinity = std::numeric_limits<T>::infinity();
  EXPECT_EQ(clamp01(T(0)), T(0));
  EXPECT_EQ(clamp01(T(1)), T(1));
  EXPECT_EQ(clamp01(T(0.25)), T(0.25));
  EXPECT_EQ(clamp01(std::numeric_limits<T>::denorm_min()), std::numeric_limits<T>::denorm_min());
  EXPECT_EQ(clamp01(std::nextafter(T(1), T(0))), std::nextafter(T(1), T(0)));
  EXPECT_EQ(clamp01(std::nextafter(T(1), T(2))), T(1));
  EXPECT_EQ(clamp01(T(-1e-30)), T(0));
  EXPECT_EQ(clamp01(infinity), T(1));
  EXPECT_EQ(clamp01(-infinity), T(0));
  EXPECT_EQ(clamp01(std::numeric_limits<T>::quiet_NaN()), T(0));
  EXPECT_EQ(clamp01(-std::numeric_limits<T>::quiet_NaN()), T(0));
}

TEST(PipelineLanes, Clamp01) {
  expect_clamped<float>();
  expect_clamped<double>();
}

TEST(PipelineLanes, BlockPixelsRowByRowFromTheBottom) {
  for (int i = 0; i < kBlockPixels; ++i) {
    const Pixels<float> p = block_pixels<float>(40, 8, i);
    EXPECT_EQ(p.x, 40 + i % 4);
    EXPECT_EQ(p.y, 8 + i / 4);
    EXPECT_EQ(p.x_win, static_cast<double>(p.x) + 0.5);
    EXPECT_EQ(p.y_win, static_cast<double>(p.y) + 0.5);
  }
}

TEST(PipelineLanes, SelectAndStore) {
  EXPECT_EQ(select(true, 1.0f, 2.0f), 1.0f);
  EXPECT_EQ(select(false, 1.0f, 2.0f), 2.0f);
  EXPECT_EQ(select(true, 1.0, 2.0), 1.0);
  EXPECT_EQ(select(false, 1.0, 2.0), 2.0);
  float at = 5;
  store(false, 7.0f, &at);
  EXPECT_EQ(Lanes<float>::load(&at), 5);
  store(true, 7.0f, &at);
  EXPECT_EQ(Lanes<float>::load(&at), 7);
}

}  // namespace
}  // namespace plumbline::pipeline

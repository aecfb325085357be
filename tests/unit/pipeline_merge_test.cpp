// Stage 11: the nearest code, its boundaries, and float frames.
#include "pipeline/merge.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace plumbline::pipeline {
namespace {

float code_of(float value, float largest = 255) { return merge<float>({value, value, value, value}, largest).r; }
constexpr int kLargest[] = {255, 4095};  // rgba8, rgba12

TEST(PipelineMerge, EveryCodeIsItsOwn) {
  for (int n : kLargest) {
    const auto largest = static_cast<float>(n);
    for (int k = 0; k <= n; ++k) {
      EXPECT_EQ(code_of(static_cast<float>(k) / largest, largest), static_cast<float>(k));
      EXPECT_EQ(code_of(static_cast<float>((k + 0.49) / n), largest), static_cast<float>(k));
      EXPECT_EQ(code_of(static_cast<float>((k - 0.49) / n), largest), static_cast<float>(k));
    }
  }
}

TEST(PipelineMerge, HalvesOfTheProductGoToTheEven) {
  for (int n : kLargest) {
    const auto largest = static_cast<float>(n);
    int halves = 0;
    for (int k = 0; k < n; ++k) {
      auto value = static_cast<float>((k + 0.5) / n);
      for (int i = 0; i < 4; ++i) value = std::nextafter(value, 0.0f);
      for (int i = 0; i < 9; ++i, value = std::nextafter(value, 1.0f)) {
        const float product = value * largest;
        EXPECT_EQ(code_of(value, largest), std::nearbyint(product)) << value;
        halves += product == static_cast<float>(k) + 0.5f;
        // The product's own rounding, half an ULP below 256 or 4096, may take it onto the half: no further than that.
        EXPECT_LE(std::abs(code_of(value, largest) - static_cast<double>(value) * n), 0.5 + (n + 1) * 0x1p-25) << value;
      }
    }
    EXPECT_GT(halves, n / 3);
  }
}

TEST(PipelineMerge, JustBelowAndJustAboveTheHalf) {
  for (int n : kLargest) {
    const auto largest = static_cast<float>(n);
    for (int k = 0; k < n; ++k) {
      EXPECT_EQ(code_of(static_cast<float>((k + 0.499) / n), largest), static_cast<float>(k));
      EXPECT_EQ(code_of(static_cast<float>((k + 0.501) / n), largest), static_cast<float>(k + 1));
    }
  }
}

TEST(PipelineMerge, IsClamped) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (float below : {-0.0f, -1e-30f, -0.5f, -3.0f, -infinity}) EXPECT_EQ(code_of(below), 0) << below;
  for (float above : {1.0f, std::nextafter(1.0f, 2.0f), 1.01f, 77.0f, infinity})
    EXPECT_EQ(code_of(above), 255) << above;
  EXPECT_EQ(code_of(infinity, 4095), 4095);
  EXPECT_EQ(code_of(-infinity, 4095), 0);
  EXPECT_EQ(code_of(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_EQ(code_of(-std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(PipelineMerge, ChannelsKeepTheirPlaces) {
  const Color<float> c = merge<float>({0, 1.0f / 255, 2.0f / 255, 3.0f / 255}, 255);
  EXPECT_EQ(c.r, 0);
  EXPECT_EQ(c.g, 1);
  EXPECT_EQ(c.b, 2);
  EXPECT_EQ(c.a, 3);
}

TEST(PipelineMerge, FloatPassesThrough) {
  const float infinity = std::numeric_limits<float>::infinity();
  const Color<float> c = merge<float>({-0.25f, 7.5f, 1e-42f, infinity}, 0);
  EXPECT_EQ(c.r, -0.25f);
  EXPECT_EQ(c.g, 7.5f);
  EXPECT_EQ(c.b, 1e-42f);
  EXPECT_EQ(c.a, infinity);
}

}  // namespace
}  // namespace plumbline::pipeline

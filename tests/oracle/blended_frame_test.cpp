// Blending in a pixel of the frame: roundings in float and in codes.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "reference/arithmetic/frame_color.h"
#include "tests/oracle/blended_frames.h"

namespace plumbline::math {
namespace {

// Sixteen layers of haze, rounded in float as a renderer rounds them.
TEST(BlendedFrame, AFloatFrameHoldsTheRoundingsOfBlendingInFloat) {
  const Merge haze = [] {
    Merge out = blending(BlendFactor::constant_alpha, BlendFactor::one_minus_constant_alpha);
    out.blend->color.a = 0.01f;
    return out;
  }();
  std::mt19937 random(1);
  const auto drawn = [&] { return std::uniform_real_distribution<float>(0, 1)(random); };
  int beyond_double = 0;
  for (int i = 0; i < 400; ++i) {
    const FrameFormat frame = frame_of(ColorFormat::rgba32f, glm::vec4(drawn()));
    const auto in = [&](BlendedIn numbers) {
      return FrameColor(frame, Conventions::Blending::in_float, Conventions::Rounding::nearest, numbers);
    };
    FrameColor floats = in(BlendedIn::floats), doubles = in(BlendedIn::doubles);
    float held = frame.clear_color.r;
    for (int layer = 0; layer < 16; ++layer) {
      const float color = drawn(), alpha = haze.blend->color.a, rest = 1 - alpha;
      const float source = color * alpha, stored = held * rest;
      held = source + stored;
      for (FrameColor* by : {&floats, &doubles}) by->write(haze, around(glm::dvec4(color), 0));
    }
    const auto holds = [&](const FrameColor& by) {
      return by.written()[0].lo <= static_cast<double>(held) && static_cast<double>(held) <= by.written()[0].hi;
    };
    EXPECT_TRUE(holds(floats)) << i;
    EXPECT_LT(floats.written()[0].hi - floats.written()[0].lo, 2 * 16 * (4 * 2 + 1) * 0x1p-24);
    beyond_double += holds(doubles) ? 0 : 1;
  }
  EXPECT_GT(beyond_double, 100);
}

// A clear colour of 127.5 codes: a renderer that rounds fragments down may clear to 128, and blend over that.
TEST(BlendedFrame, AClearColorMayBeRoundedToTheNearest) {
  const Merge adds = blending(BlendFactor::one, BlendFactor::one);
  const auto over = [&](Conventions::Rounding rounding) {
    FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0.5f)), Conventions::Blending::in_codes, rounding);
    color.write(adds, around(glm::dvec4(46 / 255.0), 0));
    return std::pair(255 * color.written()[0].lo, 255 * color.written()[0].hi);
  };
  const auto [low, high] = over(Conventions::Rounding::down);
  EXPECT_LE(low, 127 + 46 - 0.5);
  EXPECT_GE(high, 128 + 46 - 0.5);
  EXPECT_LT(high - low, 6);
  EXPECT_LT(over(Conventions::Rounding::nearest).second - over(Conventions::Rounding::nearest).first, 5);
}

// Constants of 76.5 codes: a renderer that blends in codes takes 76 or 77.
TEST(BlendedFrame, ConstantsAreCodesWhereBlendingIs) {
  Merge merge = blending(BlendFactor::constant_color, BlendFactor::constant_alpha);
  merge.blend->color = glm::vec4(0.3f);
  FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(253 / 255.0f)), Conventions::Blending::in_codes);
  color.write(merge, around(glm::dvec4(253 / 255.0), 0));
  for (const double constant : {76.0, 77.0}) {
    const double sum = 2 * std::nearbyint(253 * constant / 255);
    EXPECT_LE(255 * color.written()[0].lo, sum + 0.5);
    EXPECT_GE(255 * color.written()[0].hi, sum - 0.5);
  }
  EXPECT_LT(255 * (color.written()[0].hi - color.written()[0].lo), 7) << "of both constants 2, of four roundings 4";
  merge = blending(BlendFactor::constant_color, BlendFactor::one_minus_constant_color);
  merge.blend->color = glm::vec4(1);
  FrameColor kept(frame_of(ColorFormat::rgba8, glm::vec4(0)), Conventions::Blending::in_codes);
  kept.write(merge, around(glm::dvec4(100 / 255.0), 0));
  EXPECT_NEAR(255 * kept.written()[0].hi, 101.5, 1e-9) << "a constant of a code is that code";
}

// Source, constant and products truncated to codes.
TEST(BlendedFrame, CodesAreRoundedDownWhereThatIsDeclared) {
  std::mt19937 random(2);
  const auto drawn = [&](double most) { return std::uniform_real_distribution<double>(0, most)(random); };
  for (int i = 0; i < 2000; ++i) {
    const double source = drawn(255), constant = drawn(255), held = std::floor(drawn(255));
    Merge merge = blending(BlendFactor::constant_color, BlendFactor::one_minus_constant_color,
                           i % 2 == 0 ? BlendEquation::add : BlendEquation::subtract);
    merge.blend->color = glm::vec4(static_cast<float>(constant / 255));
    FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(static_cast<float>(held / 255))),
                     Conventions::Blending::in_codes, Conventions::Rounding::down);
    color.write(merge, around(glm::dvec4(source / 255), 0));
    const double k = std::floor(constant), s = std::floor(std::floor(source) * k / 255),
                 d = std::floor(held * (255 - k) / 255), sum = std::clamp(i % 2 == 0 ? s + d : s - d, 0.0, 255.0);
    EXPECT_LE(255 * color.written()[0].lo, sum + 1e-6) << i;
    EXPECT_GE(255 * color.written()[0].hi, sum - 1e-6) << i;
  }
}

// Products truncated, factors to the nearest: 50 * 50 / 255 and 193 * 62 / 255 make 9 + 46.
TEST(BlendedFrame, ProductsAloneAreRoundedDownWhereThatIsDeclared) {
  const auto range = [](Conventions::Blending blending_in) {
    FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(62, 62, 62, 62) / 255.0f), blending_in);
    color.write(blending(BlendFactor::source_alpha, BlendFactor::one_minus_destination_alpha),
                around(glm::dvec4(50 / 255.0), 0));
    return std::pair(255 * color.written()[0].lo, 255 * color.written()[0].hi);
  };
  const double exact = (50 * 50 + 62 * 193) / 255.0;
  const auto [low, high] = range(Conventions::Blending::in_codes_down);
  EXPECT_LE(low, 55.5) << "55 and half a code";
  EXPECT_GE(low, exact - 3.001) << "of two products, and of the factor 50";
  EXPECT_LE(high, exact + 0.501);
  EXPECT_GT(range(Conventions::Blending::in_codes).first, 55.5);
}

// d + a (s - d) for s a + d (1 - a).
TEST(BlendedFrame, AFloatFrameHoldsMixesByOneProduct) {
  Merge mix = blending(BlendFactor::constant_alpha, BlendFactor::one_minus_constant_alpha);
  std::mt19937 random(3);
  const auto drawn = [&](float least, float most) {
    return std::uniform_real_distribution<float>(least, most)(random);
  };
  for (int i = 0; i < 4000; ++i) {
    const float s = drawn(0, 0.1f), d = drawn(0, 1), a = drawn(0.9f, 1);
    mix.blend->color.a = a;
    FrameColor color(frame_of(ColorFormat::rgba32f, glm::vec4(d)), Conventions::Blending::in_float,
                     Conventions::Rounding::nearest, BlendedIn::floats);
    color.write(mix, around(glm::dvec4(s), 0));
    const float difference = s - d, product = a * difference, mixed = d + product;
    EXPECT_LE(color.written()[0].lo, static_cast<double>(mixed)) << i;
    EXPECT_GE(color.written()[0].hi, static_cast<double>(mixed)) << i;
  }
}

// The lesser of two codes is multiplied by nothing: half a code of the source's rounding.
TEST(BlendedFrame, LeastAndLargestAreNoProducts) {
  FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(100 / 255.0f)), Conventions::Blending::in_codes);
  color.write(blending(BlendFactor::one, BlendFactor::one, BlendEquation::min), around(glm::dvec4(50 / 255.0), 0));
  EXPECT_NEAR(255 * color.written()[0].lo, 49.5, 1e-9);
  EXPECT_NEAR(255 * color.written()[0].hi, 50.5, 1e-9);
}

}  // namespace
}  // namespace plumbline::math

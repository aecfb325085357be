// A pixel of the frame in intervals: by hand, and against the pipeline's blending of random fragments.
#include "reference/arithmetic/frame_color.h"

#include <array>
#include <random>

#include <gtest/gtest.h>

#include "kernels/merge.h"
#include "tests/oracle/blended_frames.h"

namespace plumbline {
namespace {

using math::around;
using math::FrameColor;

constexpr int kFactors = 15, kEquations = 5;

TEST(FrameColor, WhatIsWrittenLastIsNotRoundedButWhatIsReadIs) {
  FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0.3f)));  // 76.5 and some 1e-6
  EXPECT_EQ(color.written()[0].lo, static_cast<double>(0.3f));
  color.write({}, around(glm::dvec4(10.25 / 255), 0));
  EXPECT_EQ(color.written()[0].lo, 10.25 / 255);
  color.write(blending(BlendFactor::zero, BlendFactor::one), around(glm::dvec4(1), 0));
  EXPECT_EQ(color.written()[0].lo, 10 / 255.0);
  EXPECT_EQ(color.written()[0].hi, 10 / 255.0);
}

TEST(FrameColor, HalvesOnTheWayGoEitherWay) {
  FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0)));
  color.write({}, around(glm::dvec4(10.5 / 255), 0));
  color.write(blending(BlendFactor::zero, BlendFactor::one), around(glm::dvec4(1), 0));
  EXPECT_EQ(color.written()[0].lo, 10 / 255.0);
  EXPECT_EQ(color.written()[0].hi, 11 / 255.0);
}

// 10.5 codes and 1e-6: the lower code by double, either by the roundings of float, 255 times 8 of 2^-24 (1.2e-4).
TEST(FrameColor, SumsNearAHalfGoEitherWayInFloat) {
  const auto read = [](math::BlendedIn numbers, double code) {
    FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0)), Conventions::Blending::in_float,
                     Conventions::Rounding::nearest, numbers);
    color.write(blending(BlendFactor::one, BlendFactor::one), around(glm::dvec4(code / 255), 0));
    color.write(blending(BlendFactor::zero, BlendFactor::one), around(glm::dvec4(1), 0));
    return std::array{std::round(255 * color.written()[0].lo), std::round(255 * color.written()[0].hi)};
  };
  using Codes = std::array<double, 2>;
  for (const double off : {1e-6, 1.2e-4}) {
    EXPECT_EQ(read(math::BlendedIn::doubles, 10.5 - off), (Codes{10, 10}));
    EXPECT_EQ(read(math::BlendedIn::doubles, 10.5 + off), (Codes{11, 11}));
    EXPECT_EQ(read(math::BlendedIn::floats, 10.5 - off), (Codes{10, 11}));
    EXPECT_EQ(read(math::BlendedIn::floats, 10.5 + off), (Codes{10, 11}));
  }
  EXPECT_EQ(read(math::BlendedIn::floats, 10.5 - 1.3e-4), (Codes{10, 10}));
  EXPECT_EQ(read(math::BlendedIn::floats, 10.5 + 1.3e-4), (Codes{11, 11}));
}

TEST(FrameColor, WhatIsReadIsRoundedAsDeclared) {
  using enum Conventions::Rounding;
  const auto read = [](Conventions::Rounding rounding, double code) {
    FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0)), Conventions::Blending::in_float, rounding);
    color.write({}, around(glm::dvec4(code / 255), 0));
    EXPECT_DOUBLE_EQ(color.written()[0].lo, code / 255) << "what is written last is not rounded";
    color.write(blending(BlendFactor::zero, BlendFactor::one), around(glm::dvec4(1), 0));
    return std::array{255 * color.written()[0].lo, 255 * color.written()[0].hi};
  };
  using Codes = std::array<double, 2>;
  EXPECT_EQ(read(down, 34.75), (Codes{34, 34}));
  EXPECT_EQ(read(nearest, 34.75), (Codes{35, 35}));
  EXPECT_EQ(read(up, 34.25), (Codes{35, 35}));
  EXPECT_EQ(read(nearest, 34.25), (Codes{34, 34}));
  EXPECT_EQ(read(down, 34), (Codes{33, 34})) << "whole but for rounding";
  EXPECT_EQ(read(up, 34), (Codes{34, 35}));
  EXPECT_EQ(read(nearest, 34), (Codes{34, 34}));
  EXPECT_EQ(read(up, 255), (Codes{255, 255}));
  EXPECT_EQ(read(down, 0), (Codes{0, 0}));
}

TEST(FrameColor, ALogicOpTakesCodesRoundedAsDeclared) {
  const auto inverted = [](Conventions::Rounding rounding) {
    FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0)), Conventions::Blending::in_float, rounding);
    Merge state;
    state.logic_op = LogicOp::copy_inverted;
    color.write(state, around(glm::dvec4(91.75 / 255), 0));
    return 255 * color.written()[0].lo;
  };
  EXPECT_NEAR(inverted(Conventions::Rounding::nearest), 255 - 92, 1e-9);
  EXPECT_NEAR(inverted(Conventions::Rounding::down), 255 - 91 + 0.5, 1e-9) << "the middle of what becomes the code";
  EXPECT_NEAR(inverted(Conventions::Rounding::up), 255 - 92 - 0.5, 1e-9);
}

TEST(FrameColor, MaskedChannelsStay) {
  FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0.2f)));
  Merge state;
  state.color_mask = {true, false, true, false};
  color.write(state, around(glm::dvec4(0.6), 0));
  EXPECT_NEAR(color.written()[0].lo, 0.6, 1e-15);
  EXPECT_EQ(color.written()[1].lo, static_cast<double>(0.2f));
  EXPECT_NEAR(color.written()[2].lo, 0.6, 1e-15);
  EXPECT_EQ(color.written()[3].lo, static_cast<double>(0.2f));
}

TEST(FrameColor, AFloatFrameIsNotClamped) {
  FrameColor color(frame_of(ColorFormat::rgba32f, glm::vec4(-0.5f, 0.5f, 2, 1)));
  color.write(blending(BlendFactor::one, BlendFactor::one), around(glm::dvec4(-1, 1, 2, 0.5), 0));
  EXPECT_EQ(math::low(color.written()), glm::vec4(-1.5f, 1.5f, 4, 1.5f));
  EXPECT_EQ(math::high(color.written()), glm::vec4(-1.5f, 1.5f, 4, 1.5f));
}

// Random states and layers: the pipeline's frame is inside the interval, or beyond it by half a code at most; and where
// the colours are known exactly, less than one interval in a hundred is wider than 1e-6.
TEST(FrameColor, HoldsThePipelines) {
  std::mt19937 random(5);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto unit = [&] { return static_cast<float>(below(2) == 0 ? below(1 << 24) * 0x1p-24 : below(256) / 255.0); };
  for (const ColorFormat format :
       {ColorFormat::rgba8, ColorFormat::rgba12, ColorFormat::rgba16, ColorFormat::rgba32f}) {
    const auto scale = static_cast<float>(color_scale(format));
    int wide = 0, all = 0;
    for (int round = 0; round < 20000; ++round) {
      const FrameFormat frame = frame_of(format, {unit(), unit(), unit(), unit()});
      const glm::vec4& clear = frame.clear_color;
      FrameColor is(frame);
      pipeline::Color<float> ours = pipeline::merge<float>({clear.r, clear.g, clear.b, clear.a}, scale);
      for (int layer = below(4); layer >= 0; --layer) {
        const auto term = [&] {
          return BlendTerm{static_cast<BlendFactor>(below(kFactors)), static_cast<BlendFactor>(below(kFactors - 1)),
                           static_cast<BlendEquation>(below(kEquations))};
        };
        Merge state;
        state.blend = Blend{term(), term(), {unit(), unit(), unit(), unit()}};
        const pipeline::Color<float> source{unit(), unit(), unit(), unit()};
        is.write(state, around(glm::dvec4(source.r, source.g, source.b, source.a), 0));
        ours = pipeline::blend<float>(*state.blend, source, ours, scale);
      }
      const double one = scale == 0 ? 1 : scale, half = scale == 0 ? 0 : 0.5 + 1e-9;
      const float channels[] = {ours.r, ours.g, ours.b, ours.a};
      for (std::size_t c = 0; c < 4; ++c) {
        const auto [lo, hi] = is.written()[c];
        const double v = channels[c];
        EXPECT_TRUE(v >= lo * one - half && v <= hi * one + half) << v << " in " << lo * one << " to " << hi * one;
        wide += hi - lo > 1e-6 ? 1 : 0;
        ++all;
      }
    }
    EXPECT_LT(wide, all / 100) << static_cast<int>(format);
  }
}

// OpenGL 2.1 spec, table 4.2, written out for s = 1100, d = 1010 in the upper four bits, the lower all 0.
TEST(FrameColor, LogicOpsAreThoseOfTheTableHereAndInThePipeline) {
  constexpr int kTable[] = {0x00, 0x80, 0x40, 0xc0, 0x20, 0xa0, 0x60, 0xe0,
                            0x1f, 0x9f, 0x5f, 0xdf, 0x3f, 0xbf, 0x7f, 0xff};
  for (int op = 0; op < 16; ++op) {
    Merge state;
    state.logic_op = static_cast<LogicOp>(op);
    state.blend = Blend{};  // has no say
    FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(0xa0 / 255.0f)));
    color.write(state, around(glm::dvec4(0xc0 / 255.0), 0));
    EXPECT_EQ(color.written()[0].lo, kTable[op] / 255.0) << op;
    EXPECT_EQ(color.written()[3].hi, kTable[op] / 255.0) << op;
    const float s = 0xc0 / 255.0f, d = 0xa0;
    EXPECT_EQ(pipeline::logic<float>(*state.logic_op, {s, s, s, s}, {d, d, d, d}, 255).g,
              static_cast<float>(kTable[op]));
    EXPECT_EQ(pipeline::logic<float>(*state.logic_op, {s, s, s, s}, {d, d, d, d}, 0).g, s) << "a float replaces";
  }
}

TEST(FrameColor, ALogicOpOfACodeThatMayBeEitherIsOpen) {
  Merge state;
  state.logic_op = LogicOp::xor_;
  FrameColor color(frame_of(ColorFormat::rgba8, glm::vec4(127 / 255.0f)));
  color.write(state, around(glm::dvec4(127.5 / 255), 0.01 / 255));
  EXPECT_EQ(color.written()[0].lo, 0) << "127 ^ 127";
  EXPECT_EQ(color.written()[0].hi, 1) << "128 ^ 127 is 255";
}

}  // namespace
}  // namespace plumbline

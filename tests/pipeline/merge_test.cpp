// Stage 11: the nearest code, its boundaries, and float frames.
#include "kernels/merge.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace plumbline::pipeline {
namespace {

float code_of(float value, float largest = 255) { return merge<float>({value, value, value, value}, largest).r; }
constexpr int kLargest[] = {255, 4095, 65535};  // rgba8, rgba12, rgba16

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
        const double exact = static_cast<double>(value) * n;
        const double product = n < 65535 ? static_cast<double>(value * largest) : exact;
        ASSERT_EQ(code_of(value, largest), std::nearbyint(product)) << value;
        halves += product == k + 0.5;
        // The product's own rounding, half an ULP below 256 or 4096, may take it onto the half: no further than that.
        ASSERT_LE(std::abs(code_of(value, largest) - exact), n < 65535 ? 0.5 + (n + 1) * 0x1p-25 : 0.5) << value;
      }
    }
    EXPECT_GT(halves, n < 65535 ? n / 3 : 0);
  }
}

TEST(PipelineMerge, JustBelowAndJustAboveTheHalf) {
  for (int n : kLargest) {
    const auto largest = static_cast<float>(n);
    const double off = n < 65535 ? 0.001 : 0.004;  // the float nearest to the half is up to 0.002 codes of 65535 off
    for (int k = 0; k < n; ++k) {
      EXPECT_EQ(code_of(static_cast<float>((k + 0.5 - off) / n), largest), static_cast<float>(k));
      EXPECT_EQ(code_of(static_cast<float>((k + 0.5 + off) / n), largest), static_cast<float>(k + 1));
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

// OpenGL 2.1 spec, tables 4.1 and 4.2, for one source and one destination.
struct ColorCase {
  BlendFactor factor;
  glm::dvec4 expected;  // the factor
};
const glm::dvec4 kSource(0.25, 0.5, 0.75, 0.375), kStored(51, 102, 204, 153), kConstant(0.125, 0.625, 0.0625, 0.875);
const glm::dvec4 kIn01 = kStored / 255.0;
const ColorCase kFactors[] = {
    {BlendFactor::zero, glm::dvec4(0)},
    {BlendFactor::one, glm::dvec4(1)},
    {BlendFactor::source_color, kSource},
    {BlendFactor::one_minus_source_color, 1.0 - kSource},
    {BlendFactor::destination_color, kIn01},
    {BlendFactor::one_minus_destination_color, 1.0 - kIn01},
    {BlendFactor::source_alpha, glm::dvec4(0.375)},
    {BlendFactor::one_minus_source_alpha, glm::dvec4(0.625)},
    {BlendFactor::destination_alpha, glm::dvec4(0.6)},
    {BlendFactor::one_minus_destination_alpha, glm::dvec4(0.4)},
    {BlendFactor::constant_color, kConstant},
    {BlendFactor::one_minus_constant_color, 1.0 - kConstant},
    {BlendFactor::constant_alpha, glm::dvec4(0.875)},
    {BlendFactor::one_minus_constant_alpha, glm::dvec4(0.125)},
    {BlendFactor::source_alpha_saturate, glm::dvec4(0.375, 0.375, 0.375, 1)},
};
Color<float> color(const glm::dvec4& c) {
  const glm::vec4 f(c);
  return {f.r, f.g, f.b, f.a};
}
glm::dvec4 blended(const BlendTerm& term, float scale, const glm::dvec4& source = kSource) {
  const Color<float> c =
      blend<float>({term, term, glm::vec4(kConstant)}, color(source), color(scale == 0 ? kIn01 : kStored), scale);
  return {c.r, c.g, c.b, c.a};
}

TEST(PipelineBlend, EachFactorOnEitherSide) {
  for (const ColorCase& c : kFactors) {
    for (const ColorCase& d : kFactors) {
      if (d.factor == BlendFactor::source_alpha_saturate) continue;
      const glm::dvec4 expected = kSource * c.expected + kIn01 * d.expected;
      const glm::dvec4 is = blended({c.factor, d.factor, BlendEquation::add}, 255);
      const glm::dvec4 in_float = blended({c.factor, d.factor, BlendEquation::add}, 0);
      for (int k = 0; k < 4; ++k) {
        const double sum = std::nearbyint(0x1p40 * 255 * expected[k]) / 0x1p40;  // 76.5, not 76.5 and some 2^-47
        EXPECT_EQ(is[k], std::min(std::nearbyint(sum), 255.0))
            << static_cast<int>(c.factor) << " " << static_cast<int>(d.factor) << " channel " << k;
        EXPECT_NEAR(in_float[k], expected[k], 3e-7);  // kIn01 and the sum, rounded to float
      }
    }
  }
}

TEST(PipelineBlend, SaturateTakesWhatIsFree) {
  const Blend state{{BlendFactor::source_alpha_saturate, BlendFactor::one, BlendEquation::add}, {}, glm::vec4(0)};
  EXPECT_EQ(blend<float>(state, {1, 1, 1, 0.75f}, {0, 0, 0, 204}, 255).r, 51) << "1 - 0.8, not 0.75";
  EXPECT_EQ(blend<float>(state, {1, 1, 1, 0.1f}, {0, 0, 0, 204}, 255).r, 26) << "0.1: 25.5 to the even";
}

TEST(PipelineBlend, EachEquation) {
  const auto with = [](BlendEquation equation) { return BlendTerm{BlendFactor::one, BlendFactor::one, equation}; };
  const glm::dvec4 s(0.8, 0.1, 0.5, 1);
  EXPECT_EQ(blended(with(BlendEquation::add), 255, s), glm::dvec4(255, 128, 255, 255));  // 25.5 + 102: half to even
  EXPECT_EQ(blended(with(BlendEquation::subtract), 255, s), glm::dvec4(153, 0, 0, 102));
  EXPECT_EQ(blended(with(BlendEquation::reverse_subtract), 255, s), glm::dvec4(0, 76, 76, 0));
  EXPECT_EQ(blended({BlendFactor::zero, BlendFactor::zero, BlendEquation::min}, 255, s), glm::dvec4(51, 26, 128, 153));
  EXPECT_EQ(blended({BlendFactor::zero, BlendFactor::zero, BlendEquation::max}, 255, s),
            glm::dvec4(204, 102, 204, 255));
}

TEST(PipelineBlend, CodesClampTheSourceAndTheSumAFloatFrameDoesNot) {
  const BlendTerm sum{BlendFactor::one, BlendFactor::one, BlendEquation::subtract};
  const glm::dvec4 source(3, -1, 0.5, 2);
  EXPECT_EQ(blended(sum, 255, source), glm::dvec4(204, 0, 0, 102));
  const glm::dvec4 in_float = blended(sum, 0, source);
  EXPECT_NEAR(in_float.r, 2.8, 3e-7);
  EXPECT_NEAR(in_float.g, -1.4, 3e-7);
}

TEST(PipelineBlend, HalvesGoToTheEvenCode) {
  const BlendTerm half{BlendFactor::zero, BlendFactor::constant_alpha, BlendEquation::add};
  for (int n : kLargest) {
    for (int k = 0; k <= n; ++k) {
      const auto code = static_cast<float>(k);
      const Color<float> c =
          blend<float>({half, half, glm::vec4(0.5f)}, {}, {code, code, code, code}, static_cast<float>(n));
      EXPECT_EQ(c.r, std::nearbyint(k / 2.0)) << k;
    }
  }
}

TEST(PipelineBlend, AlphaHasItsOwnTerm) {
  const Blend state{{BlendFactor::zero, BlendFactor::one, BlendEquation::add},
                    {BlendFactor::one, BlendFactor::zero, BlendEquation::add},
                    glm::vec4(0)};
  const Color<float> c = blend<float>(state, color(kSource), color(kStored), 255);
  EXPECT_EQ(c.r, 51);
  EXPECT_EQ(c.g, 102);
  EXPECT_EQ(c.b, 204);
  EXPECT_EQ(c.a, 96) << "255 * 0.375 = 95.6";
}

}  // namespace
}  // namespace plumbline::pipeline

// Stages 7 and 9: perspective-correct means, worked out by hand.
#include "kernels/attributes.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "kernels/shade.h"
#include "tests/at_weights.h"
#include "tests/pipeline/window_triangles.h"

namespace plumbline::pipeline {
namespace {

using testing_words::color_setup;
using testing_words::window_triangle;
using testing_words::window_vertex;
using Triangle = ShadedTriangle;

Color<float> at(const Triangle& t, int x, int y) {
  const BarycentricPlanes planes = planes_of(t, 0, 0);
  const Offset<float> offset = from_anchor<float>(planes, Pixels<float>{x, y, x + 0.5, y + 0.5});
  return mean<float>(color_setup(t), weights<float>(perspective_setup(t, planes, true), offset));
}

Color<float> attributes_at(const Triangle& t, double l1, double l2) {
  return test::attributes_at(t, color_setup(t), l1, l2);
}

const glm::vec4 kA(1, 0, 0.25f, 1), kB(0, 1, 0.75f, 0.5f), kC(0.5f, 0.125f, 0, 0);

/// Corners on pixel centres; l1 and l2 grow by 1/8 per pixel along x and y.
Triangle triangle(float w0, float w1, float w2) {
  return window_triangle(window_vertex({0.5f, 0.5f, 0}, w0, kA), window_vertex({8.5f, 0.5f, 0}, w1, kB),
                         window_vertex({0.5f, 8.5f, 0}, w2, kC));
}

TEST(PipelineAttributes, CornersHaveTheirOwn) {
  const Triangle t = triangle(1, 4, 0.5f);
  const glm::vec4 expected[] = {kA, kB, kC};
  const Color<float> is[] = {at(t, 0, 0), at(t, 8, 0), at(t, 0, 8)};
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(is[i].r, expected[i].r);
    EXPECT_EQ(is[i].g, expected[i].g);
    EXPECT_EQ(is[i].b, expected[i].b);
    EXPECT_EQ(is[i].a, expected[i].a);
  }
}

TEST(PipelineAttributes, AffineWhereWIsTheSame) {
  const Color<float> c = at(triangle(2, 2, 2), 2, 4);  // 1/4 A, 1/4 B, 1/2 C
  EXPECT_EQ(c.r, 0.5f);
  EXPECT_EQ(c.g, 0.3125f);
  EXPECT_EQ(c.b, 0.25f);
  EXPECT_EQ(c.a, 0.375f);
}

// Legs of `leg` pixels and w from 1 to 1.2: each q_i and their sum change by at most 1 / leg per pixel.
Triangle slow_triangle(double leg) {
  const auto side = static_cast<float>(0.5 + leg);
  return window_triangle(window_vertex({0.5f, 0.5f, 0}, 1, kA), window_vertex({side, 0.5f, 0}, 1.1f, kB),
                         window_vertex({0.5f, side, 0}, 1.2f, kC));
}

TEST(PipelineAttributes, WithinBlocksGoInFloatFromTheBlocksFirstPixel) {
  const Triangle t = slow_triangle(48);
  const PerspectiveSetup s = perspective_setup(t, planes_of(t, 0, 0), true);
  ASSERT_TRUE(s.in_blocks);
  int other_than_in_double = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      const int column = x % 4, row = y % 4, first_x = x - column, first_y = y - row;
      const auto value = [&](const Affine<double>& f) {
        const double first = f.at_0 + first_y * f.y + first_x * f.x;
        return static_cast<float>(first) + (static_cast<float>(column) * static_cast<float>(f.x) +
                                            static_cast<float>(row) * static_cast<float>(f.y));
      };
      const Weights<float> expected = weights<float>(value(s.q1), value(s.q2), value(s.sum));
      const Offset<float> at{static_cast<double>(x), static_cast<double>(y)};
      const Weights<float> is = weights<float>(s, at);
      ASSERT_EQ(is.k1, expected.k1) << x << ", " << y;
      ASSERT_EQ(is.k2, expected.k2) << x << ", " << y;
      PerspectiveSetup in_double = s;
      in_double.in_blocks = false;
      other_than_in_double += weights<float>(in_double, at).k1 != is.k1 ? 1 : 0;
    }
  }
  EXPECT_GT(other_than_in_double, 50) << "of 576: else these are not two ways";
}

TEST(PipelineAttributes, OnlyColoursWhoseWeightsChangeLittleGoInBlocks) {
  const auto in_blocks = [](const Triangle& t, bool colors_alone = true) {
    return perspective_setup(t, planes_of(t, 0, 0), colors_alone).in_blocks;
  };
  EXPECT_TRUE(in_blocks(slow_triangle(48)));
  EXPECT_FALSE(in_blocks(slow_triangle(48), false)) << "texture coordinates are interpolated as well";
  // q_1 changes by 1 / 1.1 over the leg, at most by 1 / 12 in three steps of 1/1.2 / 6 each: legs of 6.545 on.
  EXPECT_TRUE(in_blocks(slow_triangle(6.6)));
  EXPECT_FALSE(in_blocks(slow_triangle(6.5)));
  Triangle far = slow_triangle(48);  // 1/w near the least floats, where a slope would be rounded to 0
  for (auto& v : far.v) v.inv_w *= 0x1p-61f;
  EXPECT_FALSE(in_blocks(far));
  Triangle line = slow_triangle(48);
  line.corners = 2;
  EXPECT_FALSE(in_blocks(line));
}

TEST(PipelineAttributes, HalfWayBetweenW1And4) {
  // (1/2 / 1) : (1/2 / 4) = 4 : 1.
  const Color<float> c = at(triangle(1, 4, 1), 4, 0);
  EXPECT_NEAR(c.r, 0.8, 1e-7);
  EXPECT_NEAR(c.g, 0.2, 1e-7);
  EXPECT_NEAR(c.b, 0.35, 1e-7);
  EXPECT_NEAR(c.a, 0.9, 1e-7);
  const Color<float> other = at(triangle(4, 1, 1), 4, 0);
  EXPECT_NEAR(other.r, 0.2, 1e-7);
  EXPECT_NEAR(other.g, 0.8, 1e-7);
  const Color<float> third = at(triangle(1, 1, 4), 0, 4);
  EXPECT_NEAR(third.r, 0.8 + 0.2 * 0.5, 1e-7);
  EXPECT_NEAR(third.g, 0.2 * 0.125, 1e-7);
}

TEST(PipelineAttributes, AgainstLongDouble) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> unit(0, 1), w(0.1f, 20);
  for (int i = 0; i < 5000; ++i) {
    const Triangle t = triangle(w(random), w(random), w(random));
    const double l1 = static_cast<double>(unit(random)), l2 = static_cast<double>(unit(random)) * (1 - l1),
                 l0 = 1 - l1 - l2;
    const long double weight[] = {l0, l1, l2};
    long double sum = 0;
    glm::vec<4, long double> mean(0);
    for (std::size_t k = 0; k < 3; ++k) {
      sum += weight[k] * t.v[k].inv_w;
      mean += weight[k] * t.v[k].inv_w * glm::vec<4, long double>(t.attributes[k].color());
    }
    mean /= sum;
    // Of each k_i: one rounding of its numerator, one of the sum, two of the quotient; then of the mean.
    const Color<float> c = attributes_at(t, l1, l2);
    const double bound = 12 * 0x1p-24;
    ASSERT_NEAR(c.r, static_cast<double>(mean.r), bound);
    ASSERT_NEAR(c.g, static_cast<double>(mean.g), bound);
    ASSERT_NEAR(c.b, static_cast<double>(mean.b), bound);
    ASSERT_NEAR(c.a, static_cast<double>(mean.a), bound);
  }
}

TEST(PipelineAttributes, EqualCornersGiveExactlyThatValue) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1), w(0.01f, 100);
  std::uniform_real_distribution<double> weight(-3, 3);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec4 color(unit(random), unit(random), unit(random), unit(random));
    Triangle t = triangle(w(random), w(random), w(random));
    for (auto& a : t.attributes) a.color() = color;
    const double l1 = weight(random), l2 = weight(random);  // off the triangle too
    const Color<float> c = attributes_at(t, l1, l2);
    ASSERT_EQ(glm::vec4(c.r, c.g, c.b, c.a), color);
  }
}

TEST(PipelineAttributes, OnTheHorizonThereIsNoDivisionByZero) {
  // 1/w of 1 and 0.5, extrapolated by l0 = -1, l1 = 2: their sum is 0.
  const Color<float> c = attributes_at(triangle(1, 2, 1), 2.0, 0.0);
  EXPECT_EQ(glm::vec4(c.r, c.g, c.b, c.a), kA) << "corner 0's colour";
  const Color<float> near = attributes_at(triangle(1, 2, 1), 2.0000002, 0.0);
  EXPECT_TRUE(std::isfinite(near.r) && std::isfinite(near.g) && std::isfinite(near.b) && std::isfinite(near.a));
}

TEST(PipelineAttributes, BeyondTheHorizonTheMeanGoesOn) {
  // Weights -1 and 2 / 4: of their sum, -1/2, they are 2 and -1.
  const Color<float> c = attributes_at(triangle(1, 4, 1), 2.0, 0.0);
  EXPECT_EQ(glm::vec4(c.r, c.g, c.b, c.a), 2.0f * kA - kB);
}

TEST(PipelineAttributes, BesideTheHorizonOfTheFarthestCornersToo) {
  // w near the largest float: the sum of the weights is subnormal, and 1 over it beyond every float.
  Triangle t = triangle(3e38f, 1.5e38f, 3e38f);
  for (auto& a : t.attributes) a.color() = kA;
  const Color<float> c = attributes_at(t, -1.0001, 0);
  EXPECT_EQ(glm::vec4(c.r, c.g, c.b, c.a), kA) << c.r;
}

TEST(PipelineAttributes, SetUpIsDifferencesFromCornerZero) {
  const AttributeSetup s = color_setup(triangle(1, 4, 0.5f));
  EXPECT_EQ(s.value0, kA);
  EXPECT_EQ(s.delta1, kB - kA);
  EXPECT_EQ(s.delta2, kC - kA);
}

TEST(PipelineShade, IsTheAttributesColour) {
  const Scene scene;
  const Draw draw;
  const Color<float> c = shade<float>({&scene, &draw, {}, {}, {}}, true, {{0.1f, -2, 3, 0.4f}, {}, {}});
  EXPECT_EQ(glm::vec4(c.r, c.g, c.b, c.a), glm::vec4(0.1f, -2, 3, 0.4f));
}

}  // namespace
}  // namespace plumbline::pipeline

// Stages 6, 7 and 9 of the exact reference against numbers by hand, and on slivers against areas in 113 bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "reference/exact/barycentric.h"
#include "reference/exact/coverage.h"
#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

using exact::Float128;

/// The stage's answer for the triangle at the pixels given.
Capture at(Stage stage, const WindowTriangle<double>& triangle, std::initializer_list<glm::ivec2> pixels,
           DepthFormat format = DepthFormat::z24) {
  Scene scene = scene_of(64, 64);
  scene.frame.depth = format;
  Records<double> in;
  in.triangles = {triangle};
  for (const glm::ivec2 p : pixels)
    in.covered.push_back({0, static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y)});
  return run(scene, stage, in);
}

TEST(ExactDepth, ThePlaneAtTheCentreUnrounded) {
  const auto t = window_triangle({{{0, 0, 0}, {8, 0, 0.5}, {0, 8, 0.25}}});
  for (DepthFormat format : {DepthFormat::z8, DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
    const auto z = at(Stage::depth, t, {{1, 2}, {0, 0}, {6, 1}}, format).records.depth;
    ASSERT_EQ(z.size(), 3u);
    EXPECT_EQ(z[0], 1.5 / 16 + 2.5 / 32);
    EXPECT_EQ(z[1], 0.5 / 16 + 0.5 / 32);
    EXPECT_EQ(z[2], 6.5 / 16 + 1.5 / 32);
  }
}

TEST(ExactDepth, Thirds) {
  // Corners on centres; (1,1) is the centroid: a third of 0.1 + 0.2 + 0.7.
  const auto t = window_triangle({{{0.5, 0.5, 0.1}, {3.5, 0.5, 0.2}, {0.5, 3.5, 0.7}}});
  EXPECT_NEAR(at(Stage::depth, t, {{1, 1}}).records.depth.at(0), 1.0 / 3, 1e-16);
}

TEST(ExactDepth, IsClampedAfterInterpolation) {
  const auto t = window_triangle({{{0, 4, -1}, {8, 0, 2}, {8, 8, 2}}});
  const auto z = at(Stage::depth, t, {{1, 4}, {3, 4}, {6, 4}}).records.depth;
  EXPECT_EQ(z[0], 0);
  EXPECT_NEAR(z[1], -1 + 3 * 3.5 / 8, 1e-15);
  EXPECT_EQ(z[2], 1);
}

TEST(ExactDepth, GoesThroughTheUnsnappedPositions) {
  auto t = window_triangle({{{0.501, 0.5, 0}, {8.501, 0.5, 1}, {0.501, 8.5, 0}}});
  ASSERT_EQ(t.v[0].snapped, glm::ivec2(0, 0));
  EXPECT_NEAR(at(Stage::depth, t, {{2, 1}}).records.depth.at(0), 1.999 / 8, 1e-15);
}

TEST(ExactDepth, GoesThroughTheSnappedOnesWhereOnlyTheyHaveThisFacing) {
  const std::array<glm::ivec2, 3> snapped = {{{0, 0}, {1024, 0}, {0, 1024}}};
  const auto with = [&](std::array<glm::dvec3, 3> p_win) {
    auto t = window_triangle(p_win);
    for (std::size_t i = 0; i < 3; ++i) t.v[i].snapped = snapped[i];
    t.front = true;
    return at(Stage::depth, t, {{1, 2}}).records.depth.at(0);
  };
  EXPECT_EQ(with({{{0.5, 0.5, 0}, {4.5, 4.5, 0.5}, {2.5, 2.5, 0.25}}}), 0.125 + 0.125) << "no unsnapped area";
  EXPECT_EQ(with({{{0.5, 0.5, 0}, {0.5, 6.5, 0.5}, {6.5, 0.5, 0.25}}}), 0.125 + 0.125) << "the other facing";
  EXPECT_NEAR(with({{{0.5, 0.5, 0}, {6.5, 0.5, 0.5}, {0.5, 6.5, 0.25}}}), 1.0 / 12 + 1.0 / 12, 1e-16) << "the same";
}

// --- slivers

struct Sliver {
  WindowTriangle<double> triangle;
  std::vector<Covered> covered;
};

/// Long and a few snapping steps wide, in floats, as a renderer would hold them.
Sliver random_sliver(std::mt19937& random) {
  std::uniform_real_distribution<float> place(0, 1024), narrow(-0.02f, 0.02f), unit(0, 1);
  const glm::vec2 a{place(random), place(random)}, b{place(random), place(random)};
  const float along = unit(random);
  const glm::vec2 c = a + (b - a) * along + glm::vec2{narrow(random), narrow(random)};
  auto t = window_triangle({{glm::dvec3(a, unit(random)), glm::dvec3(b, unit(random)), glm::dvec3(c, unit(random))}});
  for (auto& v : t.v) {
    v.inv_w = unit(random) + 0.01f;
    for (int k = 0; k < 4; ++k) v.color[k] = unit(random);
  }
  Sliver sliver{t, {}};
  exact::append_covered(exact::CoveredRows(exact::snapped_corners(t), 1024, 1024), 0, sliver.covered);
  return sliver;
}

/// Barycentric coordinates of the pixel's centre in the unsnapped triangle, by plain products in 113 bits.
std::array<Float128, 3> areas(const WindowTriangle<double>& t, int x, int y) {
  const Float128 px = x + 0.5, py = y + 0.5;
  std::array<Float128, 3> area;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 &b = t.v[(i + 1) % 3].p_win, &c = t.v[(i + 2) % 3].p_win;
    area[i] = Float128{b.x} * c.y - Float128{b.y} * c.x + (Float128{b.y} - c.y) * px + (Float128{c.x} - b.x) * py;
  }
  const Float128 sum = area[0] + area[1] + area[2];
  for (Float128& a : area) a /= sum;
  return area;
}

double magnitude(Float128 v) { return std::abs(static_cast<double>(v)); }

TEST(ExactFragments, SliversAreRight) {
  std::mt19937 random(6);
  Scene scene = scene_of(1024, 1024);
  double largest_weight = 0, double_precision_is_off_by = 0;
  int fragments = 0, snapped_plane = 0;
  for (int i = 0; i < 3000; ++i) {
    const Sliver sliver = random_sliver(random);
    const WindowTriangle<double>& t = sliver.triangle;
    const glm::dvec2 e1(t.v[1].p_win - t.v[0].p_win), e2(t.v[2].p_win - t.v[0].p_win);
    const Float128 area = Float128{e1.x} * e2.y - Float128{e1.y} * e2.x;
    if ((area > 0) != t.front || area == 0) {
      ++snapped_plane;  // not this test's matter
      continue;
    }
    Records<double> in;
    in.triangles = {t};
    in.covered = sliver.covered;
    const auto depth = run(scene, Stage::depth, in).records.depth;
    const auto attributes = run(scene, Stage::attributes, in).records.attributes;
    ASSERT_EQ(depth.size(), sliver.covered.size());
    ASSERT_EQ(attributes.size(), sliver.covered.size());
    for (std::size_t f = 0; f < sliver.covered.size(); ++f, ++fragments) {
      const int x = sliver.covered[f].x, y = sliver.covered[f].y;
      const auto b = areas(t, x, y);
      Float128 z = 0, iw = 0, red = 0;
      double terms = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        z += b[k] * t.v[k].p_win.z;
        iw += b[k] * t.v[k].inv_w;
        red += b[k] * t.v[k].inv_w * t.v[k].color.r;
        terms = std::max(terms, magnitude(b[k]));
      }
      largest_weight = std::max(largest_weight, terms);
      const double clamped = std::clamp(static_cast<double>(z), 0.0, 1.0);
      ASSERT_NEAR(depth[f], clamped, 4e-16 * terms) << "pixel " << x << "," << y;
      // A quotient of two sums, each good to 2^-52 of its terms.
      const double bound = 1e-15 * terms * (1 + magnitude(red / iw)) / magnitude(iw);
      ASSERT_NEAR(attributes[f].color.r, static_cast<double>(red / iw), bound) << "pixel " << x << "," << y;

      const glm::dvec2 q = glm::dvec2(x + 0.5, y + 0.5);
      const auto cross = [](glm::dvec2 u, glm::dvec2 v) { return u.x * v.y - u.y * v.x; };
      const double b1 = cross(q - glm::dvec2(t.v[0].p_win), e2) / cross(e1, e2);
      double_precision_is_off_by = std::max(double_precision_is_off_by, magnitude(b1 - b[1]) / terms);
    }
  }
  EXPECT_GT(fragments, 5000);
  EXPECT_LT(snapped_plane, 1000);
  // A weight over 1 is outside the unsnapped sliver; over 2, further outside than the sliver is wide.
  EXPECT_GT(largest_weight, 2) << "no sliver's snapped edges left its unsnapped ones";
  EXPECT_GT(double_precision_is_off_by, 1e-13) << "plain double would have passed: the slivers are too fat";
}

// --- attributes

TEST(ExactAttributes, PerspectiveCorrect) {
  auto t = window_triangle({{{0.5, 0.5, 0}, {4.5, 0.5, 0}, {0.5, 4.5, 0}}});
  t.v[0].inv_w = 1, t.v[1].inv_w = 0.25, t.v[2].inv_w = 0.5;
  t.v[0].color = {0, 1, 0, 1}, t.v[1].color = {1, 1, 0, 2}, t.v[2].color = {0.5, 1, 3, 3};
  const auto a = at(Stage::attributes, t, {{2, 0}, {1, 1}, {0, 0}}).records.attributes;
  ASSERT_EQ(a.size(), 3u);
  const auto expect = [](glm::dvec4 is, glm::dvec4 expected) {
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(is[k], expected[k], 1e-15) << "channel " << k;
  };
  // Half way from w 1 to w 4: .125 / (.5 + .125) = .2 of the far end.
  expect(a[0].color, {0.2, 1, 0, 1.2});
  // Weights 1/2, 1/4, 1/4 times 1, 1/4, 1/2: 8, 1, 2 of 11. Nothing is clamped.
  expect(a[1].color, {2.0 / 11, 1, 6.0 / 11, (8 + 2 + 6) / 11.0});
  expect(a[2].color, {0, 1, 0, 1});
}

TEST(ExactAttributes, EachFragmentOfItsOwnTriangle) {
  Records<double> in;
  for (double red : {0.25, 0.5, 0.75}) {
    in.triangles.push_back(window_triangle({{{0, 0, red}, {8, 0, red}, {0, 8, red}}}));
    for (auto& v : in.triangles.back().v) v.color = glm::dvec4(red);
  }
  in.covered = {{0, 1, 1}, {0, 2, 1}, {2, 1, 1}};
  const Scene scene = scene_of(8, 8);
  const auto a = run(scene, Stage::attributes, in).records.attributes;
  const auto z = run(scene, Stage::depth, in).records.depth;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(a.at(i).color.r, i < 2 ? 0.25 : 0.75, 1e-16);
    EXPECT_EQ(z.at(i), i < 2 ? 0.25 : 0.75);
  }
}

TEST(ExactShade, IsTheAttributesColour) {
  Records<double> in;
  in.triangles.resize(1, window_triangle({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}}));
  in.covered = {{0, 0, 0}, {0, 1, 0}};
  in.attributes = {{{0.1, 2, -3, 0.5}}, {{1, 2, 3, 4}}};
  const auto shaded = run(scene_of(4, 4), Stage::shade, in).records.shaded;
  ASSERT_EQ(shaded.size(), 2u);
  EXPECT_EQ(shaded[0].color, glm::dvec4(0.1, 2, -3, 0.5));
  EXPECT_EQ(shaded[1].color, glm::dvec4(1, 2, 3, 4));
}

TEST(ExactFragments, RefusesRecordsThatDoNotFit) {
  const Scene scene = scene_of(8, 8);
  Records<double> in;
  in.triangles.resize(2, window_triangle({{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}}}));
  for (const std::vector<Covered>& bad :
       {std::vector<Covered>{{2, 0, 0}}, {{0, 8, 0}}, {{0, 0, 8}}, {{1, 0, 0}, {0, 0, 0}}}) {
    in.covered = bad;
    EXPECT_THROW(run(scene, Stage::depth, in), std::invalid_argument);
    EXPECT_THROW(run(scene, Stage::attributes, in), std::invalid_argument);
  }
}

}  // namespace
}  // namespace plumbline

// The diamond-exit rule twice: by columns (src/kernels), and by intersecting the segment with every diamond
// (reference/exact).
#include <algorithm>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "kernels/line_diamond.h"
#include "reference/exact/line_coverage.h"
#include "tests/cross/pixels_by_rows.h"

namespace {

using plumbline::exact::line_pixels;
using plumbline::exact::produces;
using plumbline::raster::diamond_exit_line;
using plumbline::test::by_rows;
using plumbline::test::Pixels;

::testing::AssertionResult agree(glm::i64vec2 a, glm::i64vec2 b, glm::ivec2 frame) {
  const Pixels ours = by_rows(diamond_exit_line(a, b, frame)), exact = line_pixels(a, b, frame.x, frame.y);
  if (ours == exact) return ::testing::AssertionSuccess();
  auto failure = ::testing::AssertionFailure() << fmt::format("{},{} to {},{}:", a.x, a.y, b.x, b.y);
  for (const glm::ivec2 p : ours) failure << fmt::format(" {},{}", p.x, p.y);
  failure << "; exact:";
  for (const glm::ivec2 p : exact) failure << fmt::format(" {},{}", p.x, p.y);
  return failure;
}

// The definition itself, on what the specification says of it.
TEST(ExactLineCoverage, ADiamondOwnsItsRightCornerAndRightSides) {
  const glm::i64vec2 far(2000, 256), pixel(1, 1), centre(256, 256);
  const auto owns = [&](int x, int y) { return produces(centre + glm::i64vec2(x, y), far, pixel); };
  EXPECT_TRUE(owns(0, 0));
  EXPECT_TRUE(owns(128, 0));  // from the right corner on to the right: it starts inside
  EXPECT_TRUE(owns(64, 64));
  EXPECT_TRUE(owns(64, -64));
  EXPECT_FALSE(owns(129, 0));
  EXPECT_FALSE(owns(65, 64));
  // The left side and the corners at top and bottom, from which the line leaves without crossing.
  const auto leaves = [&](int x, int y) {
    const glm::i64vec2 p = centre + glm::i64vec2(x, y);
    return produces(p, p + glm::i64vec2(8 * x, 8 * y), pixel);
  };
  EXPECT_TRUE(leaves(64, 64));
  EXPECT_FALSE(leaves(-128, 0));
  EXPECT_FALSE(leaves(-64, 64));
  EXPECT_FALSE(leaves(-64, -64));
  EXPECT_FALSE(leaves(0, 128));
  EXPECT_FALSE(leaves(0, -128));
  // A line that ends in a diamond does not produce it; one that ends on a foreign border does.
  EXPECT_FALSE(produces({-500, 256}, centre, pixel));
  EXPECT_FALSE(produces({-500, 256}, centre + glm::i64vec2(128, 0), pixel));
  EXPECT_TRUE(produces({-500, 256}, centre + glm::i64vec2(129, 0), pixel));
  EXPECT_TRUE(produces({256, -500}, centre + glm::i64vec2(0, 128), pixel));
  EXPECT_FALSE(produces(centre, centre, pixel));
}

// Bresenham's, half open, where the ends are centres, as the specification says.
TEST(ExactLineCoverage, BetweenCentresTheLastPixelIsNotDrawn) {
  EXPECT_EQ(diamond_exit_line({0, 0}, {4 * 256, 0}, {8, 8}), (Pixels{{0, 0}, {1, 0}, {2, 0}, {3, 0}}));
  EXPECT_EQ(diamond_exit_line({256, 5 * 256}, {256, 3 * 256}, {8, 8}), (Pixels{{1, 5}, {1, 4}}));
  EXPECT_EQ(diamond_exit_line({0, 0}, {3 * 256, 3 * 256}, {8, 8}), (Pixels{{0, 0}, {1, 1}, {2, 2}}));
  // A tie: the line is moved by -(e, e^2), so upwards where it rises to the right, else downwards.
  EXPECT_EQ(diamond_exit_line({0, 0}, {2 * 256, 256}, {8, 8}), (Pixels{{0, 0}, {1, 1}}));
  EXPECT_EQ(diamond_exit_line({0, 256}, {2 * 256, 0}, {8, 8}), (Pixels{{0, 1}, {1, 0}}));
  EXPECT_EQ(diamond_exit_line({0, 0}, {256, 2 * 256}, {8, 8}), (Pixels{{0, 0}, {0, 1}}));
  EXPECT_TRUE(diamond_exit_line({256, 256}, {256, 256}, {8, 8}).empty());
}

// Every pair of ends on grids of 1/8 and 1/4 pixel: all corners of diamonds, points of their sides, centres, corners of
// pixels.
TEST(ExactLineCoverage, AgreeOnAllCornersAndSidesOfASmallGrid) {
  std::int64_t lines = 0;
  for (const auto& [step, size] : {std::pair{32, 18}, std::pair{64, 20}})
    for (int i = 0; i < size * size; ++i)
      for (int j = 0; j < size * size; ++j) {
        const glm::i64vec2 a(i % size, i / size), b(j % size, j / size);
        ASSERT_TRUE(
            agree(a * std::int64_t{step} - std::int64_t{128}, b * std::int64_t{step} - std::int64_t{128}, {5, 5}));
        ++lines;
      }
  EXPECT_EQ(lines, 18 * 18 * 18 * 18 + 20 * 20 * 20 * 20);
}

TEST(ExactLineCoverage, AgreeOnRandomLines) {
  std::mt19937 random(4);
  std::int64_t pixels = 0;
  for (int i = 0; i < 100'000; ++i) {
    // All sizes; half of them in multiples of half a pixel, so that ties occur; some far off.
    const int reach = 64 << (i % 9), even = i % 2 == 0 ? 1 : 128;
    std::uniform_int_distribution<int> coordinate(-reach / even - 1, reach / even + 1), near(-300, 32 * 256 + 300);
    const glm::i64vec2 a(near(random) / even * even, near(random) / even * even);
    const glm::i64vec2 b = a + glm::i64vec2(coordinate(random), coordinate(random)) * std::int64_t{even};
    ASSERT_TRUE(agree(a, b, {32, 31}));
    pixels += static_cast<std::int64_t>(diamond_exit_line(a, b, {32, 31}).size());
  }
  EXPECT_GT(pixels, 400'000);
}

TEST(ExactLineCoverage, TheFrameChangesNoPixel) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> coordinate(-20 * 256, 40 * 256), size(1, 20);
  for (int i = 0; i < 20'000; ++i) {
    const glm::i64vec2 a(coordinate(random), coordinate(random)), b(coordinate(random), coordinate(random));
    const glm::ivec2 frame(size(random), size(random)), shift(24);
    Pixels expected;
    for (const glm::ivec2 p : diamond_exit_line(a + glm::i64vec2(24 * 256), b + glm::i64vec2(24 * 256), {80, 80}))
      if (const glm::ivec2 q = p - shift; q.x >= 0 && q.y >= 0 && q.x < frame.x && q.y < frame.y) expected.push_back(q);
    ASSERT_EQ(diamond_exit_line(a, b, frame), expected);
  }
}

// Rules 3 and 4: one pixel per column, and a chain of lines paints each of its pixels once, with no gap.
TEST(ExactLineCoverage, AChainHasNoGapAndNoPixelTwice) {
  std::mt19937 random(6);
  std::uniform_int_distribution<int> step(0, 700), slope(-128, 128);
  for (int chain = 0; chain < 2'000; ++chain) {
    const bool x_major = chain % 2 == 0, forward = chain % 4 < 2;
    glm::i64vec2 at(forward ? 300 : 40 * 256, 24 * 256);
    Pixels pixels;
    for (int i = 0; i < 12; ++i) {
      const int length = step(random), across = slope(random) * length / 128;
      const glm::i64vec2 next = at + glm::i64vec2(forward ? length : -length, across);
      const auto turned = [&](glm::i64vec2 p) { return x_major ? p : glm::i64vec2(p.y, p.x); };
      for (const glm::ivec2 p : diamond_exit_line(turned(at), turned(next), {64, 64}))
        pixels.push_back(x_major ? p : glm::ivec2(p.y, p.x));
      at = next;
    }
    for (std::size_t i = 1; i < pixels.size(); ++i) {
      ASSERT_EQ(pixels[i].x - pixels[i - 1].x, forward ? 1 : -1);
      ASSERT_LE(std::abs(pixels[i].y - pixels[i - 1].y), 1);
    }
  }
}

TEST(ExactLineCoverage, EndsAsFarAwayAsTheyMayBe) {
  constexpr std::int64_t kFar = std::int64_t{1} << 29;
  for (const glm::i64vec2 b : {glm::i64vec2(kFar, kFar), {kFar, kFar - 1}, {-kFar + 1, kFar}, {3000, kFar}})
    ASSERT_TRUE(agree({-kFar, -kFar}, b, {32, 32}));
  ASSERT_TRUE(agree({kFar, -kFar}, {-kFar, kFar}, {32, 32}));
  EXPECT_EQ(diamond_exit_line({-kFar, -kFar}, {kFar, kFar}, {32, 32}).size(), 32u);
  EXPECT_THROW(diamond_exit_line({-kFar - 1, 0}, {0, 0}, {32, 32}), std::invalid_argument);
  EXPECT_THROW(diamond_exit_line({0, 0}, {0, kFar + 1}, {32, 32}), std::invalid_argument);
}

// Rules that are nearly right: the comparison must refuse their lines.
TEST(ExactLineCoverage, RefusesRulesThatAreNearlyRight) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(0, 32 * 4);
  int whole_ends = 0, reversed = 0, moved = 0;
  for (int i = 0; i < 10'000; ++i) {
    const glm::i64vec2 a = glm::i64vec2(coordinate(random), coordinate(random)) * std::int64_t{64};
    const glm::i64vec2 b = glm::i64vec2(coordinate(random), coordinate(random)) * std::int64_t{64};
    const Pixels exact = line_pixels(a, b, 32, 32);
    Pixels with_end = diamond_exit_line(a, b, {32, 32});
    if (const glm::ivec2 last(glm::ivec2(b + std::int64_t{128}) / 256);
        last.x < 32 && last.y < 32 && std::find(with_end.begin(), with_end.end(), last) == with_end.end())
      with_end.push_back(last);
    whole_ends += by_rows(with_end) != exact;
    reversed += by_rows(diamond_exit_line(b, a, {32, 32})) != exact;
    // The other perturbation, +(e, e^2): borders on the left.
    Pixels mirrored;
    for (const glm::ivec2 p : diamond_exit_line(std::int64_t{31 * 256} - a, std::int64_t{31 * 256} - b, {32, 32}))
      mirrored.push_back(glm::ivec2(31) - p);
    moved += by_rows(mirrored) != exact;
  }
  EXPECT_GT(whole_ends, 7'000);
  EXPECT_GT(reversed, 7'000);
  EXPECT_GT(moved, 3'000);
}

}  // namespace

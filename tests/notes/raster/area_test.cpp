// The continuous triangle against its sampled one (note 001): what one sample per pixel gets wrong, and jaggies.
#include "notes/raster/triangle_area.h"

#include <cmath>
#include <cstdio>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "notes/raster/triangle_algorithms.h"

namespace plumbline::raster {
namespace {

constexpr int kSide = 48;
constexpr double kTiny = 1e-9;  ///< above all rounding here: at most 64 * 2^-53 * 2000

std::set<std::pair<int, int>> sampled(const Corners& corners) {
  std::set<std::pair<int, int>> out;
  for (const Span& s : cover_by_scan_line(corners, kSide, kSide)) {
    for (int x = s.begin; x < s.end; ++x) out.emplace(x, s.y);
  }
  return out;
}

/// What the sampled triangle is off, pixel by pixel: |0 or 1 - the area inside|.
struct Error {
  double sum_of_areas = 0, largest_in = 0, largest_out = 0, total = 0;
  int touched = 0;  ///< pixels that the triangle has a part of, but not all
};
Error error_of(const Corners& corners) {
  const auto pixels = sampled(corners);
  Error out;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double a = area_in_pixel(corners, x, y);
      out.sum_of_areas += a;
      const bool in = pixels.contains({x, y});
      double& largest = in ? out.largest_in : out.largest_out;
      const double off = in ? 1 - a : a;
      largest = std::max(largest, off);
      out.total += off;
      out.touched += a > kTiny && a < 1 - kTiny ? 1 : 0;
    }
  }
  return out;
}

TEST(AreaInPixel, OfHandKnownTriangles) {
  const Corners half{{{0, 0}, {256, 0}, {0, 256}}};  // centre to centre: a quarter of pixel (0, 0)'s square and more
  EXPECT_EQ(area(half), 0.5);
  EXPECT_EQ(area_in_pixel(half, 0, 0), 0.25);
  EXPECT_EQ(area_in_pixel(half, 1, 0), 0.125);
  EXPECT_EQ(area_in_pixel(half, 0, 1), 0.125);
  EXPECT_EQ(area_in_pixel(half, 1, 1), 0.0);
  const Corners all{{{-1024, -1024}, {4096, -1024}, {-1024, 4096}}};
  EXPECT_EQ(area_in_pixel(all, 2, 3), 1.0);
  const Corners clockwise{{{0, 256}, {256, 0}, {0, 0}}};
  EXPECT_EQ(area_in_pixel(clockwise, 0, 0), 0.25);
  const Corners within{{{0, 0}, {64, 0}, {0, 64}}};
  EXPECT_EQ(area_in_pixel(within, 0, 0), area(within));
  EXPECT_EQ(area_in_pixel({{{0, 0}, {512, 512}, {256, 256}}}, 0, 0), 0.0);
  constexpr int kFar = 1 << 29;
  EXPECT_NEAR(area_in_pixel({{{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}}}, 100, 100), 1.0, 64 * 0x1p-53 * 0x1p22);
}

// A triangle is convex. Where it misses the centre, a line parts them, and leaves it half of the square at most; where
// it holds the centre, it has some area around or beside it, however little.
TEST(Sampling, IsOffByLessThanAPixelAndByHalfOfOneOutside) {
  std::mt19937 random(3);
  const auto point = [&] {
    const int x = static_cast<int>(random() % (256 * (kSide - 1)));
    return glm::ivec2(x, static_cast<int>(random() % (256 * (kSide - 1))));
  };
  double in = 0, out = 0, total = 0, touched = 0;
  for (int i = 0; i < 200; ++i) {
    const Corners corners{point(), point(), point()};
    const Error e = error_of(corners);
    constexpr double kRounding = 64 * 0x1p-53 * kSide * 1.5;  // of one pixel: the header's, the diagonal the farthest
    EXPECT_NEAR(e.sum_of_areas, area(corners), kSide * kSide * kRounding) << i;
    EXPECT_LT(e.largest_in, 1.0) << i;
    EXPECT_LE(e.largest_out, 0.5 + kRounding) << i;
    in = std::max(in, e.largest_in);
    out = std::max(out, e.largest_out);
    total += e.total;
    touched += e.touched;
  }
  std::printf(
      "200 triangles: off by up to %.4f of a pixel inside, %.4f outside; on a border pixel by %.4f on average\n", in,
      out, total / touched);
  EXPECT_GT(in, 0.5);  // at corners and slivers
  EXPECT_GT(out, 0.45);
}

// What is wrong in a pixel that a long side passes through is its smaller part. For a side parallel to the pixels', at
// a distance d from the centre, 1/2 - d: 1/4 on average. For a diagonal one, (sqrt(1/2) - d)^2: 1/6 on average.
TEST(Sampling, IsOffByAQuarterAlongStraightSidesAndASixthAlongDiagonals) {
  constexpr int kFar = 256 * 1000;
  double straight = 0, diagonal = 0;
  int straight_touched = 0, diagonal_touched = 0;
  const auto add = [](const Corners& corners, int x, int y, double& sum, int& touched) {
    const double a = area_in_pixel(corners, x, y);
    if (a < kTiny || a > 1 - kTiny) return;
    sum += sampled(corners).contains({x, y}) ? 1 - a : a;
    ++touched;
  };
  for (int k = 0; k < 256; ++k) {  // all positions of a side within a pixel
    const int at = 20 * 256 + k;
    const Corners below{{{-kFar, at}, {kFar, at}, {0, -kFar}}},
        beside{{{at - kFar, kFar}, {at + kFar, -kFar}, {-kFar, -kFar}}};
    for (int i = 8; i < 24; ++i) {
      add(below, 10, i, straight, straight_touched);
      add(beside, i, 10, diagonal, diagonal_touched);
    }
  }
  // 256 positions, of which the one on the pixels' border touches none: sum of min(k, 256 - k) / 256.
  EXPECT_EQ(straight_touched, 255);
  EXPECT_NEAR(straight, 64, 1e-9);
  // d = k / 256 and 1 - k / 256: sum of (1 - d)^2 / 2 over both, less the one that touches a corner alone.
  EXPECT_EQ(diagonal_touched, 511);
  EXPECT_NEAR(diagonal, (5625216 + 5559680) / 131072.0, 1e-9);
  EXPECT_NEAR(diagonal / diagonal_touched, 1.0 / 6, 1e-3);
}

// A sliver through a centre is drawn as a whole pixel, and a needle between the centres not at all.
TEST(Sampling, ShowsAllOfNothingAndNothingOfMuch) {
  const Corners sliver{{{10 * 256 - 2, 10 * 256 - 2}, {10 * 256 + 2, 10 * 256 - 2}, {10 * 256, 10 * 256 + 2}}};
  EXPECT_EQ(sampled(sliver).size(), 1u);
  EXPECT_EQ(area(sliver), 8.0 / 65536);
  EXPECT_EQ(error_of(sliver).largest_in, 1 - 8.0 / 65536);
  const Corners needle{{{10, 129 + 2560}, {256 * 40, 2 + 2560}, {256 * 40, 254 + 2560}}};
  EXPECT_EQ(sampled(needle).size(), 0u);
  EXPECT_GT(area(needle), 19.0);
}

// A side that rises by 1 in 8 is a staircase of runs of 8, each a jump of a whole pixel, where the areas rise by 1/8.
TEST(Sampling, MakesJaggies) {
  const Corners ramp{{{0, 0}, {256 * 40, 0}, {256 * 40, 256 * 5}}};
  std::vector<int> height;
  for (int x = 1; x < 40; ++x) {
    int n = 0;
    for (int y = 0; y < 8; ++y) n += sampled(ramp).contains({x, y}) ? 1 : 0;
    height.push_back(n);
  }
  for (int x = 1; x < 40; ++x) {
    EXPECT_EQ(height[static_cast<std::size_t>(x - 1)], x / 8 + 1)
        << x;  // rows 0 <= y <= x/8: a left side's centres are in
    double area_of_column = 0;
    for (int y = 0; y < 8; ++y) area_of_column += area_in_pixel(ramp, x, y);
    EXPECT_NEAR(area_of_column, x / 8.0, 8 * 64 * 0x1p-53 * 40) << x;  // its mean height
  }
}

}  // namespace
}  // namespace plumbline::raster

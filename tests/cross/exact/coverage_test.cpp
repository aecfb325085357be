// Stage 5 of the exact reference against pictures, and against a count of crossings that shares nothing with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>

#include "reference/exact/coverage.h"
#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

using exact::CoveredRows;
using exact::Int128;
using SnappedCorners = std::array<glm::ivec2, 3>;

SnappedCorners centres(std::array<glm::ivec2, 3> pixels) {
  for (glm::ivec2& p : pixels) p *= kSubpixel;
  return pixels;
}

Capture cover(int width, int height, const std::vector<SnappedCorners>& triangles) {
  Records<double> in;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) in.triangles.push_back(snapped_triangle(triangles[i], i));
  return run(scene_of(width, height, static_cast<std::uint32_t>(triangles.size())), Stage::coverage, in);
}

/// How often each pixel is covered: . # 2 3 ..., the top row first.
std::string picture(const Capture& capture) {
  std::string text = "\n";
  for (int y = capture.planes.count.height(); y-- > 0; text += '\n')
    for (int x = 0; x < capture.planes.count.width(); ++x) {
      const auto n = capture.planes.count(x, y);
      text += n == 0 ? '.' : n == 1 ? '#' : static_cast<char>('0' + std::min(n, 9u));
    }
  return text;
}

TEST(ExactCoverage, LeftAndBottomEdgesAreIn) {
  EXPECT_EQ(picture(cover(6, 5, {centres({{{0, 0}, {4, 0}, {0, 4}}})})), R"(
......
#.....
##....
###...
####..
)");
}

TEST(ExactCoverage, ATriangleFacedAgainstItsCornersCoversNothing) {
  Records<double> in;
  in.triangles = {snapped_triangle(centres({{{0, 0}, {4, 0}, {0, 4}}}))};
  EXPECT_FALSE(run(scene_of(6, 5, 1), Stage::coverage, in).records.covered.empty());
  in.triangles[0].front = false;
  EXPECT_TRUE(run(scene_of(6, 5, 1), Stage::coverage, in).records.covered.empty());
}

TEST(ExactCoverage, RightAndTopEdgesAreOut) {
  EXPECT_EQ(picture(cover(6, 5, {centres({{{4, 0}, {4, 4}, {0, 4}}})})), R"(
......
.###..
..##..
...#..
......
)");
}

TEST(ExactCoverage, TheOtherWindingCoversTheSame) {
  EXPECT_EQ(picture(cover(6, 5, {centres({{{4, 0}, {0, 4}, {4, 4}}}), centres({{{4, 0}, {0, 0}, {0, 4}}})})), R"(
......
####..
####..
####..
####..
)");
}

TEST(ExactCoverage, CornersBetweenCentres) {
  // In row 1 from less than 2/256 pixel right of the centre of (1,1) to as much right of that of (3,1).
  EXPECT_EQ(picture(cover(5, 3, {{{{256 + 1, 255}, {3 * 256 + 3, 255}, {2 * 256, 512}}}})), R"(
.....
..##.
.....
)");
}

TEST(ExactCoverage, WhatLiesOutsideTheFrameIsCutOff) {
  EXPECT_EQ(picture(cover(4, 3, {centres({{{-9, -9}, {30, -9}, {-9, 30}}}), centres({{{2, 1}, {70, 1}, {2, 70}}})})),
            R"(
##22
##22
####
)");
  EXPECT_EQ(picture(cover(4, 1,
                          {centres({{{-5, 0}, {-1, 0}, {-1, 9}}}), centres({{{4, 0}, {9, 0}, {4, 9}}}),
                           centres({{{0, -5}, {4, -5}, {0, 0}}}), centres({{{0, 1}, {4, 1}, {0, 4}}})})),
            "\n....\n");
}

TEST(ExactCoverage, NoAreaNoPixels) {
  EXPECT_EQ(picture(cover(4, 2, {centres({{{0, 0}, {3, 0}, {1, 0}}}), centres({{{1, 1}, {1, 1}, {1, 1}}})})),
            "\n....\n....\n");
}

TEST(ExactCoverage, RecordsRunByTriangleThenRowThenColumn) {
  const Capture c = cover(4, 4, {centres({{{2, 2}, {4, 2}, {2, 4}}}), centres({{{0, 0}, {2, 0}, {0, 2}}})});
  std::string text;
  for (const Covered& f : c.records.covered)
    text += std::to_string(f.triangle) + ":" + std::to_string(f.x) + "," + std::to_string(f.y) + " ";
  EXPECT_EQ(text, "0:2,2 0:3,2 0:2,3 1:0,0 1:1,0 1:0,1 ");
}

TEST(ExactCoverage, WeightsAreOfThePrimitiveNotOfTheTriangle) {
  Records<double> in;
  const SnappedCorners pixel = centres({{{1, 1}, {2, 1}, {1, 2}}});
  in.triangles = {snapped_triangle(pixel, 7), snapped_triangle(pixel, 4099)};
  const Capture c = run(scene_of(3, 3, 5000), Stage::coverage, in);
  EXPECT_EQ(c.planes.count(1, 1), 2u);
  EXPECT_EQ(c.planes.id_sum(1, 1), id_weight(7) + id_weight(4099));
  EXPECT_EQ(c.planes.id_sum(0, 1), 0u);
}

TEST(ExactCoverage, RefusesWhatWouldNotFit) {
  // 3000 triangles, each over the whole of 512 x 512.
  const std::vector<SnappedCorners> all(3000, centres({{{-600, -600}, {2000, -600}, {-600, 2000}}}));
  EXPECT_THROW(cover(512, 512, all), OverBudget);
}

// --- against the definition: a sample moved by (+e, +e^2) is never on an edge

constexpr std::int64_t kMove = 1 << 16;  // 1/e; more than any difference of the coordinates below

/// True: pixel (x, y)'s moved centre lies inside the polygon, by the parity of the edges that a ray to the right
/// crosses, all times kMove^2.
bool inside(const std::vector<glm::ivec2>& polygon, int x, int y) {
  const Int128 px = Int128{x} * kSubpixel * kMove * kMove + kMove, py = Int128{y} * kSubpixel * kMove * kMove + 1;
  bool odd = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    glm::ivec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (a.y > b.y) std::swap(a, b);
    const Int128 ax = Int128{a.x} * kMove * kMove, ay = Int128{a.y} * kMove * kMove, by = Int128{b.y} * kMove * kMove;
    if (!(ay < py && py < by)) continue;
    const Int128 side = Int128{b.x - a.x} * (py - ay) - Int128{b.y - a.y} * (px - ax);
    EXPECT_TRUE(side != 0) << "the move is too large, or a sample is still on an edge";
    odd ^= side > 0;
  }
  return odd;
}

void expect_painted_once(int size, const std::vector<SnappedCorners>& triangles,
                         const std::vector<glm::ivec2>& polygon) {
  const Capture c = cover(size, size, triangles);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      ASSERT_EQ(c.planes.count(x, y), inside(polygon, x, y) ? 1u : 0u) << "pixel " << x << "," << y << picture(c);
}

/// Corners on a raster so coarse that centres lie on edges often.
glm::ivec2 random_corner(std::mt19937& random, int size) {
  static constexpr std::array<int, 4> kRasters = {1, 64, 128, 256};
  const int raster = kRasters[random() % 4];
  const auto coordinate = [&] { return static_cast<int>(random() % static_cast<unsigned>(size * 256 / raster + 1)); };
  const int x = coordinate(), y = coordinate();
  return glm::ivec2(x, y) * raster;
}

int side(glm::ivec2 a, glm::ivec2 b, glm::ivec2 p) { return exact::facing({a, b, p}); }

TEST(ExactCoverage, ASharedEdgeIsPaintedOnce) {
  std::mt19937 random(1);
  for (int pairs = 0; pairs < 10000;) {
    const glm::ivec2 a = random_corner(random, 8), b = random_corner(random, 8), c = random_corner(random, 8),
                     d = random_corner(random, 8);
    if (side(a, b, c) * side(a, b, d) >= 0) continue;
    ++pairs;
    const bool flipped = random() % 2 != 0;  // the shared edge run through the same way, or the other
    expect_painted_once(8, {{a, b, c}, flipped ? SnappedCorners{a, b, d} : SnappedCorners{d, b, a}}, {a, c, b, d});
    if (HasFatalFailure()) return;
  }
}

TEST(ExactCoverage, AFanIsPaintedOnce) {
  std::mt19937 random(2);
  for (int fans = 0; fans < 1000; ++fans) {
    const glm::ivec2 centre = glm::ivec2{random() % 3 + 3, random() % 3 + 3} * kSubpixel;  // on a pixel's centre
    std::vector<glm::ivec2> rim;
    // One corner in each eighth of the way round, some straight above or beside the centre.
    for (const glm::ivec2 d : {glm::ivec2(1, 0), {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}})
      rim.push_back(centre + d * static_cast<int>(random() % 600 + 1));
    std::vector<SnappedCorners> triangles;
    for (std::size_t i = 0; i < rim.size(); ++i) triangles.push_back({centre, rim[i], rim[(i + 1) % rim.size()]});
    std::shuffle(triangles.begin(), triangles.end(), random);
    expect_painted_once(9, triangles, rim);
    if (HasFatalFailure()) return;
  }
}

TEST(ExactCoverage, TiesInEveryDirection) {
  // An edge through the centre of (4,4) in each direction of a 9 x 9 raster, with the interior on either side.
  for (int dy = -4; dy <= 4; ++dy)
    for (int dx = -4; dx <= 4; ++dx) {
      if (dx == 0 && dy == 0) continue;
      const glm::ivec2 d(dx, dy), left(-dy, dx), centre(4, 4);
      const SnappedCorners t = centres({centre - d, centre + d, centre + left});
      const bool in = -dy != 0 ? -dy > 0 : dx > 0;  // the interior to the right, or above
      const Capture c = cover(9, 9, {t});
      EXPECT_EQ(c.planes.count(4, 4), in ? 1u : 0u) << dx << "," << dy << picture(c);
      EXPECT_EQ(exact::tie_is_in(-dy, dx), in);
      expect_painted_once(9, {t}, {t.begin(), t.end()});
      expect_painted_once(9, {SnappedCorners{t[1], t[0], t[2]}}, {t.begin(), t.end()});
    }
}

TEST(ExactCoverage, LargestFrame) {
  constexpr int kSize = 16384;
  const SnappedCorners lower = centres({{{0, 0}, {kSize, 0}, {0, kSize}}});
  const SnappedCorners upper = centres({{{kSize, 0}, {kSize, kSize}, {0, kSize}}});
  const CoveredRows a(lower, kSize, kSize), b(upper, kSize, kSize);
  EXPECT_EQ(exact::covered_count(a), std::size_t{kSize} * (kSize + 1) / 2);
  EXPECT_EQ(exact::covered_count(b), std::size_t{kSize} * (kSize - 1) / 2);
  for (int y = 1; y < kSize; ++y) {
    EXPECT_EQ(a.row(y).begin, 0);
    EXPECT_EQ(a.row(y).end, kSize - y);
    EXPECT_EQ(b.row(y).begin, kSize - y);
    EXPECT_EQ(b.row(y).end, kSize);
  }
}

TEST(ExactCoverage, NothingOverflowsAtTheEndsOfInt) {
  constexpr int kMin = std::numeric_limits<int>::min(), kMax = std::numeric_limits<int>::max();
  const CoveredRows all({{{kMin, kMin}, {kMax, kMin}, {0, kMax}}}, 16384, 16384);
  EXPECT_EQ(exact::covered_count(all), std::size_t{16384} * 16384);
  // y >= x, by an edge from corner to corner of the range.
  const CoveredRows half({{{kMin, kMin}, {kMax, kMax}, {kMin, kMax}}}, 16384, 16384);
  EXPECT_EQ(half.row(5000).begin, 0);
  EXPECT_EQ(half.row(5000).end, 5000) << "the diagonal's interior is to its left: out";
}

TEST(ExactCoverage, RowsWithinAScissorBoxAreThoseOfTheWholeInIt) {
  FrameFormat frame;
  frame.width = 20;
  frame.height = 16;
  const std::array<glm::ivec2, 3> corners{glm::ivec2(-500, -300), {4600, 900}, {1700, 3900}};
  std::vector<Covered> whole;
  exact::append_covered(exact::CoveredRows(corners, frame.width, frame.height), 0, whole);
  ASSERT_GT(whole.size(), 100u);
  for (const Scissor box : {Scissor{0, 0, 20, 16},
                            {3, 2, 9, 6},
                            {5, 9, 16384, 16384},
                            {19, 15, 1, 1},
                            {4, 4, 0, 5},
                            {4, 4, 5, 0},
                            {30, 0, 5, 5},
                            {0, 40, 5, 5}}) {
    Draw draw;
    draw.scissor = box;
    std::vector<Covered> is, expected;
    exact::append_covered(exact::CoveredRows(corners, frame, draw), 0, is);
    std::copy_if(whole.begin(), whole.end(), std::back_inserter(expected),
                 [&](const Covered& c) { return box.holds(c.x, c.y); });
    ASSERT_EQ(is.size(), expected.size()) << box.x << " " << box.y;
    for (std::size_t i = 0; i < is.size(); ++i) {
      EXPECT_EQ(is[i].x, expected[i].x);
      EXPECT_EQ(is[i].y, expected[i].y);
    }
  }
}

TEST(ExactCoverage, LinesAndPointsKeepToTheScissorBox) {
  FrameFormat frame;
  frame.width = 20;
  frame.height = 16;
  WindowTriangle<double> thin{};
  thin.v[0].snapped = {300, 200};
  thin.v[1].snapped = thin.v[2].snapped = {4300, 3500};
  Draw draw;
  for (const std::uint32_t corners : {2u, 1u}) {
    thin.corners = corners;
    draw.scissor.reset();
    std::vector<Covered> whole;
    exact::append_covered(thin, frame, draw, 0, whole);
    ASSERT_EQ(whole.size(), corners == 2 ? 16u : 1u);
    for (const Scissor box : {Scissor{0, 0, 20, 16}, {1, 1, 1, 1}, {2, 1, 9, 6}, {4, 4, 0, 5}, {30, 0, 5, 5}}) {
      draw.scissor = box;
      std::vector<Covered> is;
      exact::append_covered(thin, frame, draw, 0, is);
      const auto held = [&](const Covered& c) { return box.holds(c.x, c.y); };
      EXPECT_EQ(is.size(), static_cast<std::size_t>(std::count_if(whole.begin(), whole.end(), held)));
      EXPECT_TRUE(std::all_of(is.begin(), is.end(), held));
    }
  }
}

}  // namespace
}  // namespace plumbline

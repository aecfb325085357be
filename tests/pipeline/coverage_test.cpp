// Stage 5: pictures, ties in every direction, every centre painted once, and no overflow.
#include "kernels/coverage.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/notes/ascii_coverage.h"
#include "tests/pipeline/window_triangles.h"

namespace plumbline::pipeline {
namespace {

using testing_words::Picture;
using testing_words::picture_of;
using testing_words::same_picture;
using testing_words::snapped_triangle;
using testing_words::window_triangle;
using Triangle = ShadedTriangle;

bool covers(const Triangle& t, int x, int y) { return coverage<float>(edges_of(t), {x, y, x + 0.5, y + 0.5}); }
Picture picture(const Triangle& t, int width, int height) {
  return picture_of(width, height, [&](int x, int y) { return covers(t, x, y); });
}
/// With the winding given and the other one.
void expect_picture(glm::vec2 a, glm::vec2 b, glm::vec2 c, const Picture& expected) {
  const auto width = static_cast<int>(expected[0].size()), height = static_cast<int>(expected.size());
  EXPECT_TRUE(same_picture(picture(window_triangle(a, b, c), width, height), expected));
  EXPECT_TRUE(same_picture(picture(window_triangle(a, c, b), width, height), expected)) << "the other winding";
  EXPECT_TRUE(same_picture(picture(window_triangle(b, c, a), width, height), expected)) << "from another corner";
}

TEST(AsciiCoverage, ShowsBothPicturesInOne) {
  EXPECT_TRUE(same_picture({"#.", ".#"}, {"#.", ".#"}));
  const auto result = same_picture({"##", ".."}, {"#.", ".#"});
  EXPECT_FALSE(result);
  EXPECT_STREQ(result.message(), "1 missing (?), 1 extra (!)\n#!\n.?\n");
  EXPECT_FALSE(same_picture({"#"}, {"#", "#"}));
  EXPECT_FALSE(same_picture({"##"}, {"#"}));
  EXPECT_EQ(picture_of(2, 2, [](int x, int y) { return x == 1 && y == 0; }), (Picture{"..", ".#"}));
}

TEST(PipelineCoverage, ATriangleBetweenCentres) {
  expect_picture({0, 0}, {6, 0}, {0, 6},
                 {"......",  //
                  "#.....",  //
                  "##....",  //
                  "###...",  //
                  "####..",  //
                  "#####."});
}

TEST(PipelineCoverage, LeftAndBottomEdgesAreIn) {
  // A square of two triangles with its corners on centres: 3 x 3 of the 4 x 4 centres are its own.
  expect_picture({0.5f, 0.5f}, {3.5f, 0.5f}, {0.5f, 3.5f},
                 {".....",  //
                  ".....",  //
                  "#....",  //
                  "##...",  //
                  "###.."});
  expect_picture({3.5f, 3.5f}, {0.5f, 3.5f}, {3.5f, 0.5f},
                 {".....",  //
                  ".....",  //
                  ".##..",  //
                  "..#..",  //
                  "....."});
}

TEST(PipelineCoverage, ARisingDiagonalBelongsToTheTriangleBelow) {
  // To the right of y = x lies the lower triangle: the centres on it are its own.
  expect_picture({0.5f, 0.5f}, {4.5f, 0.5f}, {4.5f, 4.5f},
                 {".....",  //
                  "...#.",  //
                  "..##.",  //
                  ".###.",  //
                  "####."});
  expect_picture({0.5f, 0.5f}, {4.5f, 4.5f}, {0.5f, 4.5f},
                 {".....",  //
                  "###..",  //
                  "##...",  //
                  "#....",  //
                  "....."});
}

TEST(PipelineCoverage, ASliverCoversTheCentresThatItMeets) {
  expect_picture({0.25f, 0.25f}, {7.75f, 4}, {0.5f, 0.75f},
                 {"........",  //
                  "........",  //
                  "....#...",  //
                  "..#.....",  //
                  "#......."});
}

TEST(PipelineCoverage, TheSmallestTriangleMayCoverACentre) {
  // Half a square of one step, its lower left corner on a centre: all three edge functions are at their border there.
  EXPECT_TRUE(covers(snapped_triangle({512, 512}, {513, 512}, {512, 513}), 2, 2));
  EXPECT_FALSE(covers(snapped_triangle({512, 512}, {511, 512}, {512, 511}), 2, 2));
  EXPECT_FALSE(covers(snapped_triangle({512, 512}, {513, 512}, {513, 511}), 2, 2));
}

/// The tie rule from its definition: inside, or on an edge whose interior lies to +x, or (horizontal) to +y.
bool covers_by_definition(const Triangle& t, int x, int y) {
  const glm::dvec2 p(256 * x, 256 * y);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a(t.v[i].snapped), b(t.v[(i + 1) % 3].snapped), c(t.v[(i + 2) % 3].snapped);
    const auto side = [&](glm::dvec2 q) { return (b.x - a.x) * (q.y - a.y) - (b.y - a.y) * (q.x - a.x); };
    const double of_p = side(p) * (side(c) > 0 ? 1 : -1);
    if (of_p < 0) return false;
    if (of_p > 0) continue;
    // The third corner's place beside the edge, on the edge's own level (or, of a horizontal edge, above it).
    const bool in = a.y == b.y ? c.y > a.y : c.x > a.x + (c.y - a.y) * (b.x - a.x) / (b.y - a.y);
    if (!in) return false;
  }
  return true;
}

TEST(PipelineCoverage, TiesInEveryDirection) {
  // Edges from one centre to another in each of 24 directions, the third corner on either side.
  const glm::ivec2 a(5, 5);
  int on_edges = 0, in = 0;
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      const glm::ivec2 d(dx, dy);
      if (d == glm::ivec2(0)) continue;
      for (int side : {-1, 1}) {
        const glm::ivec2 c = a + glm::ivec2(-dy, dx) * side + d;
        const Triangle t = snapped_triangle(a * 256, (a + 2 * d) * 256, c * 256);
        const auto by_definition = picture_of(11, 11, [&](int x, int y) { return covers_by_definition(t, x, y); });
        ASSERT_TRUE(same_picture(picture(t, 11, 11), by_definition)) << "direction " << dx << "," << dy << " " << side;
        const bool middle = covers(t, a.x + d.x, a.y + d.y);
        // The interior is to the edge's left for side 1: to its right in the picture if the edge runs down.
        EXPECT_EQ(middle, dy * side < 0 || (dy == 0 && dx * side > 0)) << dx << "," << dy << " " << side;
        ++on_edges;
        in += middle;
      }
    }
  }
  EXPECT_EQ(on_edges, 48);
  EXPECT_EQ(in, 24);
}

TEST(PipelineCoverage, RandomTrianglesByDefinition) {
  std::mt19937 random(1);
  // A coarse grid, so that many centres lie on edges.
  std::uniform_int_distribution<int> place(-8, 40);
  int covered = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto corner = [&] { return glm::ivec2{place(random), place(random)} * 64; };
    const Triangle t = snapped_triangle(corner(), corner(), corner());
    if (snapped_area(t) == 0) continue;
    const Edges edges = edges_of(t);
    for (int y = -3; y < 12; ++y) {
      for (int x = -3; x < 12; ++x) {
        const bool is = coverage<float>(edges, {x, y, x + 0.5, y + 0.5});
        ASSERT_EQ(is, covers_by_definition(t, x, y)) << "triangle " << i << ", pixel " << x << "," << y;
        covered += is;
      }
    }
  }
  EXPECT_GT(covered, 10000);
}

/// How often each of 12 x 12 centres is painted.
std::array<int, 144> painted(const std::vector<Triangle>& triangles) {
  std::array<int, 144> count{};
  for (const Triangle& t : triangles) {
    if (snapped_area(t) == 0) continue;
    const Edges edges = edges_of(t);
    for (int i = 0; i < 144; ++i) {
      count[static_cast<std::size_t>(i)] += coverage<float>(edges, {i % 12, i / 12, i % 12 + 0.5, i / 12 + 0.5});
    }
  }
  return count;
}

TEST(PipelineCoverage, SharedEdgesArePaintedOnce) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> coarse(0, 11), fine(0, 12 * 256);
  int ties = 0;
  for (int i = 0; i < 6000; ++i) {
    const auto point = [&] {
      return i % 2 == 0 ? glm::ivec2{coarse(random), coarse(random)} * 256 : glm::ivec2{fine(random), fine(random)};
    };
    const glm::ivec2 a = point(), b = point(), c = point(), d = point();
    const auto side = [&](glm::ivec2 p) {
      return std::int64_t{b.x - a.x} * (p.y - a.y) - std::int64_t{b.y - a.y} * (p.x - a.x);
    };
    if (side(c) <= 0 || side(d) >= 0) continue;  // c and d on the two sides of ab
    const auto count = painted({snapped_triangle(a, b, c), snapped_triangle(b, a, d)});
    for (int n : count) ASSERT_LE(n, 1) << "pair " << i;
    // Each centre on the shared edge, its ends aside, is painted by one.
    for (int k = 0; k < 144; ++k) {
      const glm::ivec2 p(k % 12 * 256, k / 12 * 256);
      if (side(p) != 0 || glm::dot(glm::dvec2(p - a), glm::dvec2(p - b)) >= 0) continue;
      ++ties;
      ASSERT_EQ(count[static_cast<std::size_t>(k)], 1) << "pair " << i << ", pixel " << k % 12 << "," << k / 12;
    }
  }
  EXPECT_GT(ties, 400);
}

TEST(PipelineCoverage, AFanIsPaintedOnceItsHubIncluded) {
  std::mt19937 random(3);
  for (int i = 0; i < 300; ++i) {
    // The border runs around outside of the frame; the hub is a centre, or a corner of pixels.
    const glm::ivec2 hub = glm::ivec2(4 + i % 4, 4 + i / 4 % 4) * 256 + (i % 3 == 0 ? 128 : 0);
    std::vector<glm::ivec2> border;
    const int corners = 4 + i % 9;
    for (int k = 0; k < corners; ++k) {
      const double angle = (k + std::uniform_real_distribution<double>(0, 0.9)(random)) * 2 * M_PI / corners;
      border.push_back(hub +
                       glm::ivec2(std::round(std::cos(angle) * 60) * 256, std::round(std::sin(angle) * 60) * 256));
    }
    std::vector<Triangle> fan;
    for (std::size_t k = 0; k < border.size(); ++k) {
      const glm::ivec2 next = border[(k + 1) % border.size()];
      fan.push_back(k % 2 == 0 ? snapped_triangle(hub, border[k], next) : snapped_triangle(next, border[k], hub));
    }
    for (int n : painted(fan)) ASSERT_EQ(n, 1) << "fan " << i;
  }
}

TEST(PipelineCoverage, AClosedStripIsPaintedOnce) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> jitter(-1, 1);
  for (int i = 0; i < 300; ++i) {
    // A grid over the frame and beyond, its corners moved by up to half a pixel, each cell cut along either diagonal.
    constexpr int kCells = 5, kSide = 768;
    glm::ivec2 p[kCells + 1][kCells + 1];
    for (int y = 0; y <= kCells; ++y) {
      for (int x = 0; x <= kCells; ++x) {
        p[y][x] = glm::ivec2(x - 1, y - 1) * kSide + glm::ivec2{jitter(random), jitter(random)} * 128;
      }
    }
    std::vector<Triangle> triangles;
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        const glm::ivec2 a = p[y][x], b = p[y][x + 1], c = p[y + 1][x + 1], d = p[y + 1][x];
        const bool rising = jitter(random) == 0;
        triangles.push_back(rising ? snapped_triangle(a, b, c) : snapped_triangle(a, b, d));
        triangles.push_back(rising ? snapped_triangle(a, c, d) : snapped_triangle(b, c, d));
      }
    }
    const auto count = painted(triangles);
    for (int k = 0; k < 144; ++k) {
      if (k % 12 > 9 || k / 12 > 9) continue;
      ASSERT_EQ(count[static_cast<std::size_t>(k)], 1) << "grid " << i << ", pixel " << k % 12 << "," << k / 12;
    }
  }
}

TEST(PipelineCoverage, TheLargestFramesCorners) {
  constexpr int kEnd = 16384 * 256 - 128;  // the frame's right border; its left one is at -128
  const Triangle lower = snapped_triangle({-128, -128}, {kEnd, -128}, {kEnd, kEnd});
  const Triangle upper = snapped_triangle({-128, -128}, {kEnd, kEnd}, {-128, kEnd});
  for (int x : {0, 1, 8191, 16382, 16383}) {
    for (int y : {0, 1, 8191, 16382, 16383}) {
      EXPECT_EQ(covers(lower, x, y), x >= y) << x << "," << y;
      EXPECT_EQ(covers(upper, x, y), x < y) << x << "," << y;
    }
  }
  EXPECT_FALSE(covers(lower, 16384, 5));
  EXPECT_FALSE(covers(lower, 5, -1));
  EXPECT_FALSE(covers(upper, -1, 5));
  EXPECT_FALSE(covers(upper, 5, 16384));
  // One step off the diagonal decides: E is 1 in 2^45.
  const Triangle sliver = snapped_triangle({0, 0}, {kEnd, kEnd}, {kEnd - 1, kEnd});
  EXPECT_FALSE(covers(sliver, 100, 100)) << "its right side is not its own";
  EXPECT_TRUE(covers(snapped_triangle({0, 0}, {kEnd, kEnd}, {kEnd, kEnd - 1}), 100, 100));
}

TEST(PipelineCoverage, TheFarthestCornersThatReachThisStage) {
  constexpr int kFar = 1 << 28;  // 2^20 pixels, as far as stage 4 lets corners be
  const Triangle t = snapped_triangle({-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar});
  for (int x : {0, 1, 8191, 16383}) {
    for (int y : {0, 1, 8191, 16383}) EXPECT_EQ(covers(t, x, y), x >= y) << x << "," << y;
  }
}

TEST(PipelineCoverage, PixelBoundsAreThoseOfTheCentres) {
  const auto bounds = [](glm::ivec2 lo, glm::ivec2 hi) {
    const PixelBounds b = pixel_bounds(snapped_triangle(lo, {hi.x, lo.y}, hi));
    return glm::ivec4(b.x0, b.y0, b.x1, b.y1);
  };
  EXPECT_EQ(bounds({0, 0}, {256, 512}), glm::ivec4(0, 0, 2, 3)) << "centres on the border count";
  EXPECT_EQ(bounds({1, 1}, {255, 511}), glm::ivec4(1, 1, 1, 2)) << "no column at all";
  EXPECT_EQ(bounds({-256, -257}, {-1, 255}), glm::ivec4(-1, -1, 0, 1));
  EXPECT_EQ(bounds({-255, -1}, {257, 256}), glm::ivec4(0, 0, 2, 2));
}

TEST(PipelineCoverage, PixelBoundsAreTightAndLoseNothing) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> place(-1024, 3072);
  for (int i = 0; i < 2000; ++i) {
    const glm::ivec2 corner[] = {
        {place(random), place(random)}, {place(random), place(random)}, {place(random), place(random)}};
    const Triangle t = snapped_triangle(corner[0], corner[1], corner[2]);
    const PixelBounds b = pixel_bounds(t);
    const glm::ivec2 lo = glm::min(corner[0], glm::min(corner[1], corner[2]));
    const glm::ivec2 hi = glm::max(corner[0], glm::max(corner[1], corner[2]));
    const Edges edges = edges_of(t);
    for (int y = -6; y < 15; ++y) {
      ASSERT_EQ(y >= b.y0 && y < b.y1, y * 256 >= lo.y && y * 256 <= hi.y);
      for (int x = -6; x < 15; ++x) {
        if (snapped_area(t) == 0 || !coverage<float>(edges, {x, y, x + 0.5, y + 0.5})) continue;
        ASSERT_TRUE(x >= b.x0 && x < b.x1 && y >= b.y0 && y < b.y1) << "triangle " << i << " loses " << x << "," << y;
      }
    }
    for (int x = -6; x < 15; ++x) ASSERT_EQ(x >= b.x0 && x < b.x1, x * 256 >= lo.x && x * 256 <= hi.x);
  }
}

TEST(PipelineCoverage, AScissorBoxHasItsFirstColumnAndRowAndNotThoseBeyondIt) {
  const Scissor box{3, 5, 4, 2}, empty{3, 5, 0, 2};
  const auto in = [](const Scissor& b, int x, int y) { return scissor<float>(b, {x, y, x + 0.5, y + 0.5}); };
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 10; ++x) {
      EXPECT_EQ(in(box, x, y), x >= 3 && x <= 6 && y >= 5 && y <= 6) << x << " " << y;
      EXPECT_EQ(in(box, x, y), box.holds(x, y));
      EXPECT_FALSE(in(empty, x, y));
    }
  }
}

}  // namespace
}  // namespace plumbline::pipeline

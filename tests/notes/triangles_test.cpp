// The notes' own rules for triangles as they stand, each as a plain function, with a count of what they do, and the
// right number beside it.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "notes/raster/triangle_algorithms.h"

namespace plumbline {
namespace {

using Point = glm::dvec2;  // in pixels, centres at integers (note 004, section 2.1)
using PlaneTriangle = std::array<Point, 3>;
using DrawPixel = std::function<void(int x, int y)>;

/// Note 000: f_ij, and alpha, beta, gamma > 0.
double f(const Point& i, const Point& j, double x, double y) {
  return (i.y - j.y) * x + (j.x - i.x) * y + i.x * j.y - j.x * i.y;
}
bool inside_000(const PlaneTriangle& t, double x, double y) {
  const double alpha = f(t[1], t[2], x, y) / f(t[1], t[2], t[0].x, t[0].y);
  const double beta = f(t[2], t[0], x, y) / f(t[2], t[0], t[1].x, t[1].y);
  const double gamma = f(t[0], t[1], x, y) / f(t[0], t[1], t[2].x, t[2].y);
  return alpha > 0 && beta > 0 && gamma > 0;
}

/// Note 004, 2.5: E = dY (x - X) - dX (y - Y).
double e(const Point& tail, const Point& head, double x, double y) {
  return (head.y - tail.y) * (x - tail.x) - (head.x - tail.x) * (y - tail.y);
}
/// "Pixels with consistent sign for all three edges are inside. Include edge pixels on left or right edges": both kinds
/// are in, horizontal edges are neither.
bool inside_004(const PlaneTriangle& t, double x, double y) {
  int positive = 0, negative = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &tail = t[i], &head = t[(i + 1) % 3];
    const double value = e(tail, head, x, y);
    const bool on_left_or_right = value == 0 && head.y != tail.y;
    positive += value > 0 || on_left_or_right ? 1 : 0;
    negative += value < 0 || on_left_or_right ? 1 : 0;
  }
  return positive == 3 || negative == 3;
}
/// The same with horizontal edges' pixels in too: all that is not outside.
bool inside_all_edges(const PlaneTriangle& t, double x, double y) {
  int positive = 0, negative = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double value = e(t[i], t[(i + 1) % 3], x, y);
    positive += value >= 0 ? 1 : 0;
    negative += value <= 0 ? 1 : 0;
  }
  return positive == 3 || negative == 3;
}

/// The bounding box as it was meant: over the three vertices.
template <class Inside>
void draw(const PlaneTriangle& t, Inside inside, const DrawPixel& pixel) {
  const auto [x_min, x_max] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [y_min, y_max] = std::minmax({t[0].y, t[1].y, t[2].y});
  for (int y = static_cast<int>(std::floor(y_min)); y <= std::ceil(y_max); ++y) {
    for (int x = static_cast<int>(std::floor(x_min)); x <= std::ceil(x_max); ++x) {
      if (inside(t, x, y)) pixel(x, y);
    }
  }
}

constexpr int kHub = 40, kHalf = 32, kFrame = 80;

/// A square of side 64 around the hub (40, 40) as a fan of 16 triangles. All corners are on centres, and so are many
/// pixels of the spokes: 8 spokes (the axes and diagonals) have 31 inside, 8 (to half of a side) have 15: 368.
std::vector<PlaneTriangle> fan() {
  std::vector<Point> rim;
  const Point corner[] = {{1, -1}, {1, 1}, {-1, 1}, {-1, -1}};
  for (int side = 0; side < 4; ++side) {
    for (int quarter = 0; quarter < 4; ++quarter) {
      const Point a = corner[side], b = corner[(side + 1) % 4];
      rim.push_back(Point(kHub) + static_cast<double>(kHalf) * (a + (b - a) * (quarter / 4.0)));
    }
  }
  std::vector<PlaneTriangle> out;
  for (std::size_t i = 0; i < rim.size(); ++i) out.push_back({Point(kHub), rim[i], rim[(i + 1) % rim.size()]});
  return out;
}
constexpr int kOnSpokes = 8 * 31 + 8 * 15;
constexpr int kWithin = 63 * 63;  ///< pixels inside the square, its border excluded

/// How often each pixel within the square, its border excluded, is drawn.
struct TimesDrawn {
  int never = 0, once = 0, more = 0, most = 0;
};
TimesDrawn count_of(const std::map<std::pair<int, int>, int>& drawn) {
  TimesDrawn out;
  for (int y = kHub - kHalf + 1; y < kHub + kHalf; ++y) {
    for (int x = kHub - kHalf + 1; x < kHub + kHalf; ++x) {
      const auto at = drawn.find({x, y});
      const int n = at == drawn.end() ? 0 : at->second;
      ++(n == 0 ? out.never : n == 1 ? out.once : out.more);
      out.most = std::max(out.most, n);
    }
  }
  return out;
}
template <class Inside>
TimesDrawn drawn_by(Inside inside) {
  std::map<std::pair<int, int>, int> drawn;
  for (const PlaneTriangle& t : fan()) draw(t, inside, [&](int x, int y) { ++drawn[{x, y}]; });
  return count_of(drawn);
}

TEST(NotesTriangles, OneTieRuleDrawsEachPixelOfAFanOnce) {
  for (const auto cover : {raster::cover_by_barycentric, raster::cover_by_cross_products, raster::cover_by_lee,
                           raster::cover_by_scan_line}) {
    std::map<std::pair<int, int>, int> drawn;
    int all = 0;
    for (const PlaneTriangle& t : fan()) {
      const raster::Corners corners{glm::ivec2(t[0] * 256.0), glm::ivec2(t[1] * 256.0), glm::ivec2(t[2] * 256.0)};
      for (const raster::Span& s : cover(corners, kFrame, kFrame)) {
        for (int x = s.begin; x < s.end; ++x) ++drawn[{x, s.y}];
        all += s.end - s.begin;
      }
    }
    const TimesDrawn count = count_of(drawn);
    EXPECT_EQ(count.never, 0);
    EXPECT_EQ(count.once, kWithin);
    EXPECT_EQ(count.more, 0);
    EXPECT_EQ(all, 64 * 64);  // with the square's left and bottom sides
  }
}

// 000: where alpha, beta or gamma is 0 neither of two neighbours draws.
TEST(NotesTriangles, Note000StrictSignsLeaveGapsOnSharedEdges) {
  const TimesDrawn count = drawn_by(inside_000);
  EXPECT_EQ(count.never, kOnSpokes + 1);  // and the hub
  EXPECT_EQ(count.once, kWithin - kOnSpokes - 1);
  EXPECT_EQ(count.more, 0);
}

// 004: on a left or right edge both neighbours draw; on a horizontal one, which the sentence leaves open, neither. The
// hub is on a horizontal edge of 4 of the 16.
TEST(NotesTriangles, Note004LeftAndRightEdgesAreDrawnTwiceAndHorizontalOnesNever) {
  const TimesDrawn count = drawn_by(inside_004);
  EXPECT_EQ(count.never, 2 * 31);
  EXPECT_EQ(count.more, kOnSpokes - 2 * 31 + 1);
  EXPECT_EQ(count.once, kWithin - kOnSpokes - 1);
  EXPECT_EQ(count.most, 12);
}

TEST(NotesTriangles, WithHorizontalEdgesInAllSharedOnesAreDrawnTwice) {
  const TimesDrawn count = drawn_by(inside_all_edges);
  EXPECT_EQ(count.never, 0);
  EXPECT_EQ(count.more, kOnSpokes + 1);
  EXPECT_EQ(count.once, kWithin - kOnSpokes - 1);
  EXPECT_EQ(count.most, 16);
}

// 004: "E < 0: right (below); E > 0: left (up)" has it the wrong way around, and says of the same expression (f(x, y) =
// a x + b y + c, a = dY, b = -dX) in 2.2 that f > 0 is below.
TEST(NotesTriangles, Note004SignsOfEAreReversed) {
  const Point tail(0, 0), head(2, 1);
  EXPECT_EQ(e(tail, head, 5, 0), 5);    // right of the line and below it
  EXPECT_EQ(e(tail, head, 0, 5), -10);  // left of it and above
  EXPECT_EQ(e(tail, head, 4, 2), 0);    // on it
  EXPECT_EQ(e(head, tail, 5, 0), -5);   // the line walked down: the other way around again
  int as_said = 0, reversed = 0;
  for (int y = -20; y <= 20; ++y) {
    for (int x = -20; x <= 20; ++x) {
      const bool below = y<x / 2.0, above = y> x / 2.0;
      const double value = e(tail, head, x, y);
      as_said += (below && value < 0) || (above && value > 0) ? 1 : 0;
      reversed += (below && value > 0) || (above && value < 0) ? 1 : 0;
    }
  }
  EXPECT_EQ(as_said, 0);
  EXPECT_EQ(reversed, 41 * 41 - 21);  // all but those on the line
}

/// 000 as it stands: x_min = floor(x_i), x_max = ceiling(x_i), of one vertex i.
void draw_000_as_it_stands(const PlaneTriangle& t, std::size_t i, const DrawPixel& pixel) {
  for (int y = static_cast<int>(std::floor(t[i].y)); y <= std::ceil(t[i].y); ++y) {
    for (int x = static_cast<int>(std::floor(t[i].x)); x <= std::ceil(t[i].x); ++x) {
      if (inside_000(t, x, y)) pixel(x, y);
    }
  }
}

TEST(NotesTriangles, Note000BoxOfOneVertexHoldsAtMostFourPixels) {
  const PlaneTriangle t{Point(2.25, 3.25), Point(30.5, 6.75), Point(9.5, 28.25)};
  int right = 0;
  draw(t, inside_000, [&](int, int) { ++right; });
  const raster::Corners corners{glm::ivec2(t[0] * 256.0), glm::ivec2(t[1] * 256.0), glm::ivec2(t[2] * 256.0)};
  int covered = 0;
  for (const raster::Span& s : raster::cover_by_barycentric(corners, kFrame, kFrame)) covered += s.end - s.begin;
  EXPECT_EQ(right, covered) << "no centre is on an edge here: with the box of all three, the note is right";
  EXPECT_GT(covered, 300);
  for (std::size_t i = 0; i < 3; ++i) {
    int drawn = 0;
    draw_000_as_it_stands(t, i, [&](int, int) { ++drawn; });
    EXPECT_LE(drawn, 4) << i;
  }
}

// The frame's pixels are 0 to xs - 1, and NDC 1 is mapped to xs: the loops, which end at the ceiling, go there, and on,
// where a triangle does. With edges in, or a corner beyond, a pixel is drawn outside the frame.
TEST(NotesTriangles, Note000LoopsLeaveTheFrame) {
  constexpr int kXs = 16;
  const auto beyond = [](const PlaneTriangle& t, auto inside) {
    int n = 0;
    draw(t, inside, [&](int x, int y) { n += x >= kXs || y >= kXs || x < 0 || y < 0 ? 1 : 0; });
    return n;
  };
  const auto xs_of = [](double x_ndc) { return kXs / 2.0 * x_ndc + kXs / 2.0; };  // M_screen
  const PlaneTriangle at_the_border{Point(0, 0), Point(xs_of(1), 0), Point(xs_of(1), kXs - 1)};
  EXPECT_EQ(at_the_border[1].x, kXs);
  int visited = 0;
  const auto at_the_end = [](const PlaneTriangle&, double x, double) { return x == kXs; };
  draw(at_the_border, at_the_end, [&](int, int) { ++visited; });
  EXPECT_EQ(visited, kXs);
  EXPECT_EQ(beyond(at_the_border, inside_000), 0) << "saved by what leaves the gaps";
  EXPECT_EQ(beyond(at_the_border, inside_004), kXs - 1);
  const PlaneTriangle across{Point(8, 2), Point(24, 2), Point(8, 18)};
  EXPECT_GT(beyond(across, inside_000), 0);
  for (const raster::Span& s : raster::cover_by_barycentric({{{2048, 512}, {6144, 512}, {2048, 4608}}}, kXs, kXs)) {
    EXPECT_TRUE(s.begin >= 0 && s.end <= kXs && s.y >= 0 && s.y < kXs);
  }
}

}  // namespace
}  // namespace plumbline

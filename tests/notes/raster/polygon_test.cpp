// Polygons cut into triangles: no area is lost, no pixel is painted twice, and what has no answer is refused.
#include "notes/raster/polygon.h"

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

#include "notes/raster/triangle_algorithms.h"

namespace plumbline::raster {
namespace {

using PointPolygon = std::vector<glm::ivec2>;

std::int64_t twice_area(glm::i64vec2 a, glm::i64vec2 b, glm::i64vec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
std::int64_t twice_area(const PointPolygon& p) {
  std::int64_t sum = 0;
  for (std::size_t i = 2; i < p.size(); ++i) sum += twice_area(p[0], p[i - 1], p[i]);
  return sum;
}

PointPolygon reversed(PointPolygon p) {
  std::reverse(p.begin(), p.end());
  return p;
}
PointPolygon turned(PointPolygon p) {
  std::rotate(p.begin(), p.begin() + 1, p.end());
  return p;
}
PointPolygon on_centres(PointPolygon p) {
  for (glm::ivec2& corner : p) corner *= 256;
  return p;
}

constexpr int kGrid = 40;

/// By counting crossings of each row's line, moved a hair up, to the left of each centre, moved a hair to the right:
/// knows nothing of triangles. A crossing at or left of the centre counts.
bool inside(const PointPolygon& p, int x, int y) {
  bool in = false;
  for (std::size_t i = 0; i < p.size(); ++i) {
    glm::i64vec2 a = p[i], b = p[(i + 1) % p.size()];
    if (a.y > b.y) std::swap(a, b);
    const std::int64_t px = 256 * x, py = 256 * y;
    if (py < a.y || py >= b.y) continue;
    if ((b.x - a.x) * (py - a.y) <= (px - a.x) * (b.y - a.y)) in = !in;
  }
  return in;
}

/// Pieces: as many as there must be, wound as the whole, of its area together, none without; and each pixel of the
/// polygon painted once, no other.
void expect_decomposed(const PointPolygon& p, const std::string& what) {
  const std::vector<glm::uvec3> pieces = decompose(p);
  ASSERT_EQ(pieces.size(), p.size() - 2) << what;
  const std::int64_t whole = twice_area(p);
  std::int64_t sum = 0;
  std::set<std::uint32_t> used;
  std::map<std::pair<int, int>, int> painted;
  for (const glm::uvec3& t : pieces) {
    const std::int64_t piece = twice_area(p[t.x], p[t.y], p[t.z]);
    EXPECT_NE(piece, 0) << what;
    EXPECT_EQ(piece > 0, whole > 0) << what;
    sum += piece;
    for (int i = 0; i < 3; ++i) used.insert(t[i]);
    for (const Span& s : cover_by_scan_line({p[t.x], p[t.y], p[t.z]}, kGrid, kGrid)) {
      for (int x = s.begin; x < s.end; ++x) ++painted[{x, s.y}];
    }
  }
  EXPECT_EQ(sum, whole) << what;
  EXPECT_EQ(used.size(), p.size()) << what;
  int wrong = 0;
  for (int y = 0; y < kGrid; ++y) {
    for (int x = 0; x < kGrid; ++x) wrong += painted[{x, y}] == (inside(p, x, y) ? 1 : 0) ? 0 : 1;
  }
  EXPECT_EQ(wrong, 0) << what;
}

const std::map<std::string, PointPolygon>& polygons() {
  static const std::map<std::string, PointPolygon> kAll = {
      {"triangle", {{1, 1}, {9, 2}, {4, 8}}},
      {"square", {{1, 1}, {9, 1}, {9, 9}, {1, 9}}},
      {"convex", {{4, 1}, {9, 3}, {10, 8}, {6, 11}, {2, 9}, {1, 4}}},
      {"arrow, concave", {{1, 1}, {9, 4}, {1, 8}, {4, 4}}},
      {"L", {{1, 1}, {9, 1}, {9, 4}, {4, 4}, {4, 9}, {1, 9}}},
      {"comb", {{0, 0}, {20, 0}, {20, 9}, {16, 2}, {12, 9}, {8, 2}, {4, 9}, {0, 2}}},
      {"spiral",
       {{1, 1},
        {20, 1},
        {20, 20},
        {5, 20},
        {5, 6},
        {15, 6},
        {15, 15},
        {9, 15},
        {9, 10},
        {12, 10},
        {12, 12},
        {13, 12},
        {13, 8},
        {7, 8},
        {7, 18},
        {18, 18},
        {18, 3},
        {1, 3}}},
      {"corners amid its sides", {{1, 1}, {5, 1}, {9, 1}, {9, 6}, {9, 9}, {7, 9}, {1, 9}, {1, 5}, {1, 3}}},
      {"a triangle with corners amid one side", {{1, 1}, {3, 3}, {5, 5}, {9, 9}, {1, 9}}},
      {"a corner in line with a side elsewhere", {{1, 1}, {9, 1}, {9, 9}, {5, 5}, {1, 9}}},
      {"star", {{20, 1}, {23, 14}, {37, 14}, {26, 22}, {31, 36}, {20, 27}, {9, 36}, {14, 22}, {3, 14}, {17, 14}}},
  };
  return kAll;
}

TEST(Decompose, LosesNoAreaAndPaintsEachPixelOnce) {
  for (const auto& [name, pixels] : polygons()) {
    PointPolygon p = on_centres(pixels);
    for (std::size_t i = 0; i < p.size(); ++i, p = turned(p)) {
      expect_decomposed(p, name + ", from corner " + std::to_string(i));
      expect_decomposed(reversed(p), name + ", clockwise, from corner " + std::to_string(i));
    }
  }
}

TEST(Decompose, RandomStarsOffTheCentres) {
  std::mt19937 random(5);
  for (int i = 0; i < 300; ++i) {
    const std::size_t n = 4 + random() % 40;
    PointPolygon p;
    for (std::size_t k = 0; k < n; ++k) {
      const double around = 6.283185307179586 * static_cast<double>(k) / static_cast<double>(n);
      const double radius = 256 * (2 + 17 * (static_cast<double>(random()) / 4294967296.0));
      p.emplace_back(20 * 256 + static_cast<int>(radius * std::cos(around)),
                     20 * 256 + static_cast<int>(radius * std::sin(around)));
    }
    expect_decomposed(i % 2 == 0 ? p : reversed(p), "star " + std::to_string(i));
  }
}

TEST(Decompose, TheLargestCornersDoNotOverflow) {
  constexpr int kFar = 1 << 29;
  const PointPolygon p{{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {0, 0}, {-kFar, kFar}};
  std::int64_t sum = 0;
  for (const glm::uvec3& t : decompose(p)) sum += twice_area(p[t.x], p[t.y], p[t.z]);
  EXPECT_EQ(sum, std::int64_t{6} << 58);  // a square of side 2^30 without a quarter, twice
  EXPECT_THROW(decompose(PointPolygon{{-kFar - 1, 0}, {1, 0}, {0, 1}}), std::invalid_argument);
}

TEST(Decompose, RefusesWhatCrossesOrTouchesItselfOrHasNoArea) {
  const std::map<std::string, PointPolygon> bad = {
      {"nothing", {}},
      {"two corners", {{0, 0}, {5, 0}}},
      {"a line", {{0, 0}, {5, 0}, {9, 0}}},
      {"a line of four", {{0, 0}, {5, 0}, {9, 0}, {7, 0}}},
      {"bow tie", {{0, 0}, {5, 5}, {5, 0}, {0, 5}}},
      {"bow tie with an area", {{0, 0}, {5, 9}, {5, 0}, {0, 5}}},
      {"pentagram", {{20, 1}, {31, 36}, {3, 14}, {37, 14}, {9, 36}}},
      {"a corner twice in a row", {{0, 0}, {5, 0}, {5, 0}, {0, 5}}},
      {"a corner twice", {{0, 0}, {5, 5}, {9, 0}, {9, 9}, {5, 5}, {0, 9}}},
      {"a corner on a side", {{0, 0}, {9, 0}, {9, 9}, {5, 0}, {0, 9}}},
      {"a spike out and back", {{0, 0}, {9, 0}, {5, 0}, {5, 5}}},
      {"a hole by a bridge", {{0, 0}, {9, 0}, {9, 9}, {3, 3}, {6, 3}, {6, 6}, {3, 3}, {9, 9}, {0, 9}}},
  };
  for (const auto& [name, p] : bad) {
    EXPECT_THROW(decompose(p), std::invalid_argument) << name;
    EXPECT_THROW(decompose(reversed(p)), std::invalid_argument) << name;
  }
}

}  // namespace
}  // namespace plumbline::raster

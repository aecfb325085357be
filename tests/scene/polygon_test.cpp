// Polygons that may be cut into triangles, and those that may not, against a definition by whole numbers.
#include "scene/mesh/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <glm/ext/vector_int2_sized.hpp>

namespace plumbline {
namespace {

using Point = glm::i64vec2;

/// Whether two closed segments have a point in common, by Cramer's rule: a + s (b - a) = c + t (d - c).
bool meet(Point a, Point b, Point c, Point d) {
  const auto determinant = [](Point u, Point v) { return u.x * v.y - u.y * v.x; };
  const Point along = b - a, other = d - c, apart = c - a;
  const std::int64_t whole = determinant(along, other);
  const auto in_unit = [](std::int64_t part, std::int64_t of) {
    return of > 0 ? 0 <= part && part <= of : of <= part && part <= 0;
  };
  if (whole != 0) return in_unit(determinant(apart, other), whole) && in_unit(determinant(apart, along), whole);
  if (determinant(apart, along) != 0 || determinant(apart, other) != 0) return false;
  const auto overlap = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
    return std::max(std::min(p, q), std::min(r, s)) <= std::min(std::max(p, q), std::max(r, s));
  };
  return overlap(a.x, b.x, c.x, d.x) && overlap(a.y, b.y, c.y, d.y);
}

bool is_simple(const std::vector<Point>& corners) {
  const std::size_t n = corners.size();
  std::int64_t area = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point p = corners[i], q = corners[(i + 1) % n];
    area += p.x * q.y - p.y * q.x;
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n != i && meet(p, q, corners[j], corners[(j + 1) % n])) return false;
    }
  }
  return area != 0;
}

/// The corners in the plane perpendicular to `axis`, which decides onto which plane polygon_fault() projects them.
std::vector<glm::dvec3> placed(const std::vector<Point>& corners, int axis) {
  std::vector<glm::dvec3> out;
  for (const Point& p : corners) {
    glm::dvec3 at(0);
    at[axis] = 7;
    at[(axis + 1) % 3] = static_cast<double>(p.x);
    at[(axis + 2) % 3] = static_cast<double>(p.y);
    out.push_back(at);
  }
  return out;
}

TEST(Polygon, MayBeCutWhereItNeitherCrossesNorTouchesItself) {
  std::mt19937_64 random(22);
  std::size_t simple = 0, others = 0;
  for (int n = 0; n < 20'000; ++n) {
    std::vector<Point> corners(4 + random() % 4);
    for (Point& p : corners) p = {random() % 9, random() % 9};
    const bool expected = is_simple(corners);
    ++(expected ? simple : others);
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(polygon_fault(placed(corners, axis)).empty(), expected) << "polygon " << n << ", axis " << axis;
    }
  }
  EXPECT_GT(simple, 2'000u);
  EXPECT_GT(others, 2'000u);
}

TEST(Polygon, MayBeOffItsPlaneByA128thOfItsExtent) {
  // Corners of a square, h above and below its plane in turn; its extent is the diagonal of its box.
  const auto square = [](double h) {
    return polygon_fault(std::vector<glm::dvec3>{{0, 0, h}, {2, 0, -h}, {2, 2, h}, {0, 2, -h}});
  };
  const auto at = [](double share) { return share * std::sqrt(8 / (1 - 4 * share * share)); };
  EXPECT_EQ(square(0), "");
  EXPECT_EQ(square(at(0.999 / 128)), "");
  EXPECT_EQ(square(at(1.001 / 128)).find("a polygon that is not flat: corner 0 is 0.0221 off the plane"), 0u);
}

TEST(Polygon, MayBeAnyTriangle) {
  EXPECT_EQ(polygon_fault(std::vector<glm::dvec3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}), "");
}

}  // namespace
}  // namespace plumbline

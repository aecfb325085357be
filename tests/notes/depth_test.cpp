// What class notes (004) 3.2 say of Z: what projects, what a cut is, and how Z is resolved by z.
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "transforms/projection.h"
#include "transforms/viewport.h"

namespace plumbline::transforms {
namespace {

constexpr double kD = 1;  // 90 degrees

glm::dvec4 clip(const glm::dvec3& p) { return gzrender::x_pi(kD) * glm::dvec4(p, 1); }
glm::dvec3 ndc(const glm::dvec3& p) { return glm::dvec3(clip(p)) / clip(p).w; }
glm::dvec2 pixel(const glm::dvec3& p) { return glm::dvec2(gzrender::x_sp(256, 256, 1) * glm::dvec4(ndc(p), 1)); }

// "We delete all vector that Z < 0, because they cannot project to the view plane."
TEST(NotesDepth, BetweenTheEyeAndTheViewPlanePointsProject) {
  // On one ray from the eye: one pixel, whether in front of the view plane (kept) or behind it (deleted).
  EXPECT_EQ(pixel({1, 1, 1}), glm::dvec2(192, 64));
  EXPECT_EQ(pixel({0.5, 0.5, 0}), glm::dvec2(192, 64));
  EXPECT_EQ(pixel({0.25, 0.25, -0.5}), glm::dvec2(192, 64));
  EXPECT_EQ(ndc({0.25, 0.25, -0.5}).z, -1) << "to be cut for its depth, which is outside of [0, 1)";
  // What cannot project is the eye's own plane; behind it w is negative, and all is upside down.
  EXPECT_EQ(clip({0.25, 0.25, -1}).w, 0);
  EXPECT_EQ(clip({0.25, 0.25, -1.5}).w, -0.5);
  EXPECT_EQ(pixel({0.25, 0.25, -1.5}), glm::dvec2(64, 192));
  EXPECT_EQ(ndc({0.25, 0.25, -1.5}).z, 3) << "\"z in (-inf, d)\" holds in front of the eye alone";
}

double area(const std::vector<glm::dvec2>& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

TEST(NotesDepth, DeletingIsNoClipping) {
  const glm::dvec3 a(-1, -1, 1), b(1, -1, 1), c(0, 0.25, -0.5);
  // The cut at Z = 0, two thirds of the way to c.
  const glm::dvec3 from_a = a + (c - a) * (2.0 / 3), from_b = b + (c - b) * (2.0 / 3);
  ASSERT_NEAR(from_a.z, 0, 1e-15);
  // In front of the view plane there is a trapezoid, in pixels 128 and 85.3 wide and 42.7 high.
  const double right = area({pixel(a), pixel(b), pixel(from_b), pixel(from_a)});
  EXPECT_NEAR(right, (128 + 128 * 2.0 / 3) / 2 * (128.0 / 3), 1e-9);
  EXPECT_NEAR(right, 4551.1, 0.05);
  // A triangle that lost its corner, or all of itself: 0 pixels, 4551 too few. Not deleted and not cut: 8192, 3641
  // more.
  EXPECT_NEAR(area({pixel(a), pixel(b)}), 0, 1e-9);
  EXPECT_NEAR(area({pixel(a), pixel(b), pixel(c)}), 8192, 1e-9);
}

// "Do Z interpolation in Perspective Plane": on a segment's image z is linear, and Z is not.
TEST(NotesDepth, ZIsLinearOnTheScreen) {
  const glm::dvec3 a(-1, 0, 0), b(10, 0, 9);
  ASSERT_EQ(ndc(a).x, -1);
  ASSERT_EQ(ndc(b).x, 1);
  const glm::dvec4 middle = gzrender::inverse_x_pi(kD) * glm::dvec4((ndc(a) + ndc(b)) / 2.0, 1);
  const glm::dvec3 p = glm::dvec3(middle) / middle.w;
  // It is on the segment, one eleventh of the way; Z interpolated on the screen would say 4.5.
  EXPECT_NEAR(p.x, -1 + 11.0 / 11, 1e-15);
  EXPECT_NEAR(p.z, 9.0 / 11, 1e-15);
  EXPECT_NEAR(ndc({0, 0, 4.5}).z - ndc(p).z, 4.5 / 5.5 - 0.45, 1e-15) << "which is 0.368 of all depth away";
}

double code(double z_camera, double maxint) {
  return std::floor((gzrender::x_sp(1, 1, maxint) * glm::dvec4(ndc({0, 0, z_camera}), 1)).z);
}
// Codes that begin within a unit of Z.
double codes_per_unit(double z_camera, double maxint) { return code(z_camera + 1, maxint) - code(z_camera, maxint); }

// "z increase slower when Z is large. It might map different Z to the same z."
TEST(NotesDepth, ResolutionFallsWithTheSquareOfTheDistance) {
  constexpr std::array<double, 4> kMaxInts = {255, 65535, 16777215, 2147483647};
  fmt::print("codes per unit of Z, d = 1\n{:>8}", "Z");
  for (const double maxint : kMaxInts) fmt::print("{:>12}", maxint);
  fmt::print("\n");
  for (const double z : {0., 1., 3., 10., 30., 100., 300., 1000., 3000., 10000., 30000., 100000.}) {
    fmt::print("{:>8}", z);
    for (const double maxint : kMaxInts) {
      const double codes = codes_per_unit(z, maxint);
      fmt::print("{:>12}", codes);
      // z' = 1 - 1/(Z + 1): the difference over a unit. Two floors, and the ULP of a double under maxint, may cost one.
      EXPECT_NEAR(codes, maxint / ((z + 1) * (z + 2)), 1 + 1e-6) << z << " of " << maxint;
    }
    fmt::print("\n");
  }
  EXPECT_EQ(codes_per_unit(0, 65535), 32767) << "half of all codes are in the first unit";
  EXPECT_EQ(codes_per_unit(100, 65535), 6);
}

TEST(NotesDepth, AUnitIsLostWhereTheDistanceIsTheRootOfTheCodes) {
  for (const double maxint : {255., 65535., 16777215., 2147483647.}) {
    double lost = 0;
    while (code(lost, maxint) != code(lost + 1, maxint)) ++lost;
    // maxint / ((Z + 1)(Z + 2)) codes in the unit: while it is 1 or more none is lost; where it is 1/2, of two one is.
    fmt::print("of {:>10} codes, one is the same at Z = {} and {}\n", maxint + 1, lost, lost + 1);
    EXPECT_GT((lost + 1) * (lost + 2), maxint);
    EXPECT_LT((lost - 1) * lost, 2 * maxint);
  }
  EXPECT_EQ(code(5000, 16777215), 16773860);
  EXPECT_EQ(code(5001, 16777215), 16773860) << "a unit apart and the same z";
}

}  // namespace
}  // namespace plumbline::transforms

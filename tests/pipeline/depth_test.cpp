// Stage 6: planes against long double, codes of each format, and the depth test.
#include "kernels/depth.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "faults/pixel_barycentrics.h"
#include "kernels/coverage.h"
#include "kernels/visibility.h"
#include "pipeline/stages.h"
#include "tests/at_weights.h"
#include "tests/pipeline/window_triangles.h"

namespace plumbline::pipeline {
namespace {

using testing_words::window_triangle;
using testing_words::window_vertex;
using Triangle = ShadedTriangle;
constexpr double kZ16 = 65535, kZ24 = 16777215, kZ32f = 0;

Pixels<float> pixel(int x, int y) { return {x, y, x + 0.5, y + 0.5}; }
/// By planes that are anchored as in a frame: at the lower left pixel of the pixel's tile.
Barycentric weights_at(const Triangle& t, int x, int y) {
  return barycentric(planes_of(t, x / kTile * kTile, y / kTile * kTile), pixel(x, y));
}
float depth_at(const Triangle& t, int x, int y, double scale) {
  DepthSetup setup = depth_setup(t, {DepthFormat::z32f});
  setup.scale = scale;
  const BarycentricPlanes planes = planes_of(t, x / kTile * kTile, y / kTile * kTile);
  return depth<float>(depth_plane(setup, planes), from_anchor<float>(planes, pixel(x, y)));
}
Triangle with_depths(Triangle t, float z0, float z1, float z2) {
  t.v[0].p_win.z = z0;
  t.v[1].p_win.z = z1;
  t.v[2].p_win.z = z2;
  return t;
}

__extension__ using Float128 = __float128;

/// Twice the area of a, b, c. Of floats within 2^15 pixels, no finer than 2^-40, each product and sum is exact.
Float128 area_of(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) {
  return (Float128{b.x} - a.x) * (Float128{c.y} - a.y) - (Float128{b.y} - a.y) * (Float128{c.x} - a.x);
}

/// The plane through the unsnapped corners, clamped.
long double plane_at(const Triangle& t, int x, int y) {
  const glm::dvec2 a(t.v[0].p_win), b(t.v[1].p_win), c(t.v[2].p_win), p(x + 0.5, y + 0.5);
  const Float128 area = area_of(a, b, c), z0 = t.v[0].p_win.z;
  const Float128 z =
      z0 + area_of(a, p, c) / area * (t.v[1].p_win.z - z0) + area_of(a, b, p) / area * (t.v[2].p_win.z - z0);
  return std::clamp(static_cast<long double>(z), 0.0L, 1.0L);
}

/// Calls visit(x, y) for each pixel that the triangle covers in a frame of size x size, at most `reach` columns and a
/// row's run away from the line through corners 0 and 1.
template <class Visit>
void for_each_covered(const Triangle& t, int size, int reach, Visit visit) {
  const Edges edges = edges_of(t);
  const PixelBounds b = pixel_bounds(t);
  const glm::dvec2 p(t.v[0].p_win), q(t.v[1].p_win);
  for (int y = std::max(b.y0, 0); y < std::min(b.y1, size); ++y) {
    const double middle = p.x + (y + 0.5 - p.y) * (q.x - p.x) / (q.y - p.y);
    const int around = reach + static_cast<int>(std::min(std::abs((q.x - p.x) / (q.y - p.y)), 64.0));
    const int x0 = std::max({b.x0, 0, static_cast<int>(std::clamp(middle, -1e6, 1e6)) - around});
    const int x1 = std::min({b.x1, size, static_cast<int>(std::clamp(middle, -1e6, 1e6)) + around + 1});
    for (int x = x0; x < x1; ++x) {
      if (coverage<float>(edges, pixel(x, y))) visit(x, y);
    }
  }
}

TEST(PipelineDepth, BarycentricsByHand) {
  const Triangle t = window_triangle(glm::vec2(1, 1), {5, 1}, {1, 9});
  for (const auto& [x, y, l1, l2] : {std::tuple{0, 0, -0.125, -0.0625}, {1, 1, 0.125, 0.0625}, {2, 4, 0.375, 0.4375}}) {
    const Barycentric b = weights_at(t, x, y);
    EXPECT_EQ(b.l1, l1);
    EXPECT_EQ(b.l2, l2);
    EXPECT_EQ(b.l0, 1 - l1 - l2);
  }
  // The other winding: corners 1 and 2 change places.
  const Barycentric b = barycentric(planes_of(window_triangle(glm::vec2(1, 1), {1, 9}, {5, 1}), 0, 0), pixel(2, 4));
  EXPECT_EQ(b.l1, 0.4375);
  EXPECT_EQ(b.l2, 0.375);
}

TEST(PipelineDepth, ThePlanesAreTheSameFromAnyAnchor) {
  const Triangle t = window_triangle(glm::vec2(1, 1), {5, 1}, {1, 9});
  for (const auto& [x0, y0] : {std::pair{0, 0}, {2, 4}, {64, 128}, {-7, 3}}) {
    const BarycentricPlanes planes = planes_of(t, x0, y0);
    EXPECT_EQ(planes.x0, x0 + 0.5);
    EXPECT_EQ(planes.y0, y0 + 0.5);
    const Barycentric b = barycentric(planes, pixel(2, 4));
    EXPECT_EQ(b.l1, 0.375);
    EXPECT_EQ(b.l2, 0.4375);
    EXPECT_EQ(b.l0, 0.1875);
  }
}

TEST(PipelineDepth, CornersHaveTheirOwnDepths) {
  const Triangle t =
      with_depths(window_triangle(glm::vec2(2.5f, 1.5f), {10.5f, 1.5f}, {2.5f, 9.5f}), 0.25f, 0.5f, 0.875f);
  EXPECT_EQ(depth_at(t, 2, 1, kZ32f), 0.25f);
  EXPECT_EQ(depth_at(t, 10, 1, kZ32f), 0.5f);
  EXPECT_EQ(depth_at(t, 2, 9, kZ32f), 0.875f);
  EXPECT_EQ(depth_at(t, 6, 1, kZ32f), 0.375f);
  EXPECT_EQ(depth_at(t, 2, 5, kZ32f), 0.5625f);
}

TEST(PipelineDepth, AFlatTriangleHasItsDepthEverywhere) {
  const float z = 0.3f;
  const Triangle t = with_depths(window_triangle(glm::vec2(0.1f, 0.3f), {30.7f, 3.3f}, {11.9f, 27.1f}), z, z, z);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(depth_at(t, i, 20 - i, kZ32f), z);
    EXPECT_EQ(depth_at(t, i, 20 - i, kZ24), static_cast<float>(std::nearbyint(static_cast<double>(z) * kZ24)));
  }
}

// tinyrenderer's int(z + .5), z in [0,255] (note 002): at every half code up, where 16 and 24 bits go to the even.
TEST(PipelineDepth, EightBitCodesAreRoundedHalfUp) {
  int halves = 0;
  for (int k = 0; k < 255; ++k) {
    double z = (k + 0.5) / 255;
    for (int i = 0; i < 4; ++i) z = std::nextafter(z, 0.0);
    for (int i = 0; i < 9; ++i, z = std::nextafter(z, 1.0)) {
      const double scaled = z * 255;
      EXPECT_EQ(depth_code(z, 255.0), scaled < k + 0.5 ? k : k + 1) << k;
      if (k > 0) {  // below 1/2, the sum itself is rounded up
        EXPECT_EQ(depth_code(z, 255.0), static_cast<int>(scaled + .5)) << k;
      }
      halves += scaled == k + 0.5;
    }
    EXPECT_EQ(depth_code((k + 0.5) / 256, 256.0), std::nearbyint(k + 0.5)) << "other scales: half to even";
  }
  EXPECT_GT(halves, 255 / 2);
  EXPECT_EQ(depth_code(0.0, 255.0), 0);
  EXPECT_EQ(depth_code(1.0, 255.0), 255);
  EXPECT_EQ(depth_scale(DepthFormat::z8), 255);
}

TEST(PipelineDepth, CodesAreRoundedHalfToEven) {
  // One step per two pixels: every other pixel's depth is half way between two codes.
  for (double scale : {kZ16, kZ24}) {
    const DepthPlane plane{{1000, 0.5, 0}, scale, 0, scale};
    for (int x = 0; x < 64; ++x) {
      EXPECT_EQ(depth<float>(plane, {static_cast<double>(x), 0}), static_cast<float>(std::nearbyint(1000 + x / 2.0)));
    }
  }
  for (int k : {0, 1, 2, 3, 65533, 65534}) {
    const double half = (k + 0.5) / kZ16;
    if (half * kZ16 == k + 0.5) {
      EXPECT_EQ(test::depth_at({half, 0, 0, kZ16}, 0, 0), static_cast<float>(k + k % 2)) << "half way from " << k;
    }
    EXPECT_EQ(test::depth_at({half * (1 - 1e-13), 0, 0, kZ16}, 0, 0), static_cast<float>(k));
    EXPECT_EQ(test::depth_at({half * (1 + 1e-13), 0, 0, kZ16}, 0, 0), static_cast<float>(k + 1));
  }
}

TEST(PipelineDepth, EveryCodeOfZ24IsHeldByAFloat) {
  for (int k : {0, 1, 8388607, 8388608, 16777213, 16777214, 16777215}) {
    EXPECT_EQ(test::depth_at({k / kZ24, 0, 0, kZ24}, 0, 0), static_cast<float>(k));
  }
}

TEST(PipelineDepth, IsClamped) {
  const Triangle t = with_depths(window_triangle(glm::vec2(0.5f, 0.5f), {16.5f, 0.5f}, {0.5f, 16.5f}), -1, 1, 3);
  EXPECT_EQ(depth_at(t, 0, 0, kZ32f), 0);
  EXPECT_EQ(depth_at(t, 7, 0, kZ24), 0);
  EXPECT_EQ(depth_at(t, 12, 0, kZ32f), 0.5f) << "clamped after interpolation, not before";
  EXPECT_EQ(depth_at(t, 0, 12, kZ32f), 1);
  EXPECT_EQ(depth_at(t, 0, 15, kZ16), 65535);
  EXPECT_EQ(depth_at(t, 0, 15, kZ24), 16777215);
}

TEST(PipelineDepth, GoesThroughTheUnsnappedPositions) {
  // Half a step off, the snapped corners would give 2^-12 more.
  Triangle t = window_triangle(glm::vec2(0.5f, 0.5f), {8.5f, 0.5f}, {0.5f, 8.5f});
  t = with_depths(t, 0, 1, 0);
  t.v[0].p_win.x += 1.0f / 512;
  t.v[2].p_win.x += 1.0f / 512;
  const double l1 = (4 - 1.0 / 512) / (8 - 1.0 / 512);
  EXPECT_EQ(depth_at(t, 4, 0, kZ32f), static_cast<float>(l1));
}

TEST(PipelineDepth, GoesThroughTheSnappedOnesWhereTheUnsnappedHaveNoArea) {
  // Unsnapped: on one line; snapped, the last corner is one step off it, to either side.
  for (int side : {-1, 1}) {
    Triangle t = with_depths(window_triangle(glm::vec2(0.5f, 0.5f), {8.5f, 0.5f}, {4.5f, 0.5f}), 0, 1, 0);
    t.v[2].snapped.y += side;
    t.front = side > 0;
    ASSERT_NE(snapped_area(t), 0);
    EXPECT_EQ(depth_at(t, 0, 0, kZ32f), 0);
    EXPECT_EQ(depth_at(t, 2, 0, kZ32f), 0.25f);
    EXPECT_EQ(depth_at(t, 8, 0, kZ32f), 1);
  }
}

TEST(PipelineDepth, GoesThroughSnappedOnesWhereTheUnsnappedAreaHasTheOtherSign) {
  for (int side : {-1, 1}) {
    const auto lean = static_cast<float>(side) / 1024;
    Triangle t = with_depths(window_triangle(glm::vec2(0.5f, 0.5f), {8.5f, 0.5f}, {4.5f, 0.5f - lean}), 0, 1, 0.75f);
    t.v[2].snapped = {1024, side};
    t.front = side > 0;
    // At pixel (4, 1), 256 steps up from the line: l2 is 256 by the snapped corners, -1024 by the others.
    const Barycentric b = weights_at(t, 4, 1);
    EXPECT_EQ(b.l2, 256 * side);
    EXPECT_EQ(b.l1, 0.5 - 128 * side);
    // Of the same sign as the snapped: the unsnapped ones.
    t.v[2].p_win.y = 0.5f + lean;
    EXPECT_EQ(weights_at(t, 4, 1).l2, 1024 * side);
  }
}

TEST(PipelineDepth, AgainstLongDouble) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(0, 64), z(-0.1f, 1.1f);
  int codes = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::vec2 p[] = {
        {place(random), place(random)}, {place(random), place(random)}, {place(random), place(random)}};
    const Triangle t = with_depths(window_triangle(p[0], p[1], p[2]), z(random), z(random), z(random));
    if (std::abs(snapped_area(t)) < 65536) continue;  // slivers are below
    for_each_covered(t, 64, 64, [&](int x, int y) {
      const long double exact = plane_at(t, x, y);
      const float single = depth_at(t, x, y, kZ32f);
      ASSERT_LE(std::abs(single - exact), std::ldexp(1.0L, -25) + 1e-12L);
      for (double scale : {kZ16, kZ24}) {
        const long double code = exact * scale;
        // Correctly rounded, but for what double precision leaves open at a half.
        ASSERT_LE(std::abs(depth_at(t, x, y, scale) - code), 0.5L + 1e-6L)
            << "triangle " << i << " at " << x << "," << y;
        ++codes;
      }
    });
  }
  EXPECT_GT(codes, 50000);
}

/// The largest error in codes of z24.
double worst_code(const std::vector<Triangle>& triangles, int size, int& fragments) {
  long double worst = 0;
  for (const Triangle& t : triangles) {
    const Float128 area = area_of(t.v[0].p_win, t.v[1].p_win, t.v[2].p_win);
    if (snapped_area(t) == 0 || area == 0 || (area > 0) != t.front) continue;
    for_each_covered(t, size, 3, [&](int x, int y) {
      worst = std::max(worst, std::abs(depth_at(t, x, y, kZ24) - plane_at(t, x, y) * kZ24));
      ++fragments;
    });
  }
  return static_cast<double>(worst);
}

TEST(PipelineDepth, SliversAreRoundedRightly) {
  // Thinner than a float's step: the third corner is on the line of the others, but for its rounding.
  std::mt19937 random(2);
  std::uniform_real_distribution<float> place(0, 1024), unit(0, 1);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 8000; ++i) {
    const glm::vec2 a(place(random), place(random)), b(place(random), place(random));
    const Triangle t = window_triangle(a, b, a + unit(random) * (b - a));
    triangles.push_back(with_depths(t, unit(random), unit(random), unit(random)));
  }
  int fragments = 0;
  EXPECT_LE(worst_code(triangles, 1024, fragments), 0.501);
  EXPECT_GT(fragments, 500);
}

TEST(PipelineDepth, SliversWithACornerWhereFloatsAreFineAreRoundedRightly) {
  // Beside the origin floats are so fine that a double does not hold the products of the area, which nearly cancel.
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(1000, 16000), unit(0, 1);
  std::vector<Triangle> triangles;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec2 fine(unit(random) * 0.5, unit(random) * 0.5);
    const glm::vec2 b(glm::dvec2{place(random), place(random)}),
        c(fine + (0.2 + 0.6 * unit(random)) * (glm::dvec2(b) - fine));
    // Onto the line of the rounded others, and off it by about 2^-22.
    const glm::dvec2 along(glm::normalize(glm::dvec2(c) - glm::dvec2(b))), across(-along.y, along.x);
    const glm::vec2 a(fine - across * (glm::dot(fine - glm::dvec2(b), across) + (unit(random) - 0.5) * 0x1p-20));
    const auto z = static_cast<float>(unit(random));
    const auto dz = [&] { return static_cast<float>(unit(random) - 0.5) * 2e-3f; };
    triangles.push_back(with_depths(window_triangle(a, b, c), z, z + dz(), z + dz()));
  }
  int fragments = 0;
  EXPECT_LE(worst_code(triangles, 16384, fragments), 0.501);
  EXPECT_GT(fragments, 500);
}

TEST(PipelineDepth, SliversOfTheLargestFrameAreRoundedRightly) {
  // The two worst of 20,000 random slivers thinner than a float's step, over 10,000 pixels long.
  const glm::vec3 corners[2][3] = {{{0x1.3c84b2p+10f, 0x1.9edf4cp+8f, 0x1.18caeap-1f},
                                    {0x1.2d1392p+12f, 0x1.f2a78ep+13f, 0x1.d55a0ap-4f},
                                    {0x1.20098cp+12f, 0x1.d61ee8p+13f, 0x1.22261p-3f}},
                                   {{0x1.eb9172p+13f, 0x1.d1d5cap+13f, 0x1.97e8fp-6f},
                                    {0x1.0fd9c8p+13f, 0x1.de4c24p+9f, 0x1.65804cp-1f},
                                    {0x1.c6306cp+13f, 0x1.87abe2p+13f, 0x1.1c6a34p-3f}}};
  for (const auto& c : corners) {
    const Triangle t = window_triangle(window_vertex(c[0]), window_vertex(c[1]), window_vertex(c[2]));
    for_each_covered(t, 16384, 3, [&](int x, int y) {
      const long double code = plane_at(t, x, y) * kZ24;
      EXPECT_LE(std::abs(depth_at(t, x, y, kZ24) - code), 0.501L) << "pixel " << x << "," << y << ", " << code;
    });
  }
}

void expect_passes(DepthFunc func, bool less, bool equal, bool greater) {
  const auto passes = [&](float incoming, float stored) { return compares<float>(func, incoming, stored); };
  const float values[] = {
      0, std::numeric_limits<float>::denorm_min(), 0.25f, std::nextafter(0.25f, 1.0f), 1, 16777214, 16777215};
  for (float a : values) {
    for (float b : values) EXPECT_EQ(passes(a, b), a < b ? less : a > b ? greater : equal) << a << " against " << b;
  }
}

TEST(PipelineDepth, TheEightDepthFunctions) {
  expect_passes(DepthFunc::never, false, false, false);
  expect_passes(DepthFunc::less, true, false, false);
  expect_passes(DepthFunc::equal, false, true, false);
  expect_passes(DepthFunc::less_equal, true, true, false);
  expect_passes(DepthFunc::greater, false, false, true);
  expect_passes(DepthFunc::not_equal, true, false, true);
  expect_passes(DepthFunc::greater_equal, false, true, true);
  expect_passes(DepthFunc::always, true, true, true);
}

// Where the near and the far plane cut nothing, depths are clamped to where these are, whichever is the larger; else to
// what every format holds.
TEST(PipelineDepth, ClampsToTheRangeOnlyWhereNothingIsCut) {
  Draw draw;
  draw.depth_range = {0.75f, 0.25f};
  const Triangle t = with_depths(window_triangle({0, 0}, {8, 0}, {0, 8}), -2, 2, -2);
  const auto at = [&](int x, bool clamps) {
    const Barycentric b = weights_at(t, x, 0);
    return test::depth_at(depth_setup(t, depth_state(draw, DepthFormat::z32f, clamps)), b.l1, b.l2);
  };
  EXPECT_EQ(at(0, true), 0.25f);
  EXPECT_EQ(at(6, true), 0.75f);
  EXPECT_EQ(at(4, true), 0.25f);  // -2 + 4 * 4.5 / 8 = 0.25
  EXPECT_EQ(at(0, false), 0);
  EXPECT_EQ(at(6, false), 1);
}

}  // namespace
}  // namespace plumbline::pipeline

// The error bounds, against arithmetic in float done over and over: sound, and not absurdly loose.
#include "check/bounds/bounds.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "check/bounds/mean_bounds.h"
#include "check/bounds/texture_bounds.h"
#include "reference/exact/barycentric.h"
#include "tests/check/fixtures.h"
#include "tests/float_depth.h"

namespace plumbline::check {
namespace {

// splitmix64: the same numbers everywhere.
class Random {
 public:
  double in(double low, double high) {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return low + (high - low) * static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_ = 1;
};

// A triangle in a 256 x 192 window, of sides between a pixel and the window, its corners floats.
WindowTriangle<double> random_triangle(Random& r) {
  const double size = std::exp2(r.in(0, 7));
  const glm::dvec2 middle(r.in(0, 256), r.in(0, 192));
  std::array<glm::dvec3, 3> p;
  for (glm::dvec3& v : p) {
    v = glm::vec3(middle.x + r.in(-size, size), middle.y + r.in(-size, size), r.in(0, 1));
  }
  glm::dvec3 inv_w;
  for (int i = 0; i < 3; ++i) inv_w[i] = static_cast<float>(std::exp2(r.in(-4, 0)));
  WindowTriangle<double> t = triangle_of(p, inv_w);
  for (auto& v : t.v) v.color = glm::vec4(r.in(0, 1), r.in(0, 1), r.in(0, 1), 1);
  return t;
}

double unsnapped_area(const WindowTriangle<double>& t) {
  const glm::dvec2 a(t.v[0].p_win), b(t.v[1].p_win), c(t.v[2].p_win);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Barycentrics in double, by areas.
glm::dvec3 weights(const WindowTriangle<double>& t, int x, int y) {
  const glm::dvec2 p(x + 0.5, y + 0.5);
  glm::dvec3 w;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = glm::dvec2(t.v[(i + 1) % 3].p_win) - p, b = glm::dvec2(t.v[(i + 2) % 3].p_win) - p;
    w[static_cast<int>(i)] = (a.x * b.y - a.y * b.x) / unsnapped_area(t);
  }
  return w;
}

// Visits up to 12 random pixels that meet the triangle, and whose centres' barycentrics are at least -0.01.
template <class Visit>
void for_pixels(const WindowTriangle<double>& t, Random& r, Visit visit) {
  for (int n = 0; n < 12; ++n) {
    double a = r.in(0, 1), b = r.in(0, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const glm::dvec3 p = t.v[0].p_win + a * (t.v[1].p_win - t.v[0].p_win) + b * (t.v[2].p_win - t.v[0].p_win);
    const int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    if (x < 0 || y < 0 || x >= 256 || y >= 192) continue;
    const glm::dvec3 w = weights(t, x, y);
    if (std::min({w.x, w.y, w.z}) >= -0.01) visit(x, y, w);
  }
}

// A plane's value as a float pipeline has it: gradients by the corners' differences over the area, the value at the
// window's origin, and from there to the pixel.
float from_origin(const WindowTriangle<double>& t, const std::array<float, 3>& f, int x, int y) {
  const glm::vec2 p0(t.v[0].p_win), p1(t.v[1].p_win), p2(t.v[2].p_win);
  const glm::vec2 e01 = p0 - p1, e20 = p2 - p0;
  const float over_area = 1.0f / (e01.x * e20.y - e20.x * e01.y);
  const float d01 = f[0] - f[1], d20 = f[2] - f[0];
  const float dx = (d01 * (e20.y * over_area) - d20 * (e01.y * over_area));
  const float dy = (d20 * (e01.x * over_area) - d01 * (e20.x * over_area));
  const float at_origin = f[0] - (dx * (p0.x - 0.5f) + dy * (p0.y - 0.5f));
  return at_origin + dx * static_cast<float>(x) + dy * static_cast<float>(y);
}

struct Largest {
  double ratio = 0;
  std::size_t items = 0;
  void add(double diff, double bound) {
    ASSERT_GT(bound, 0);
    ratio = std::max(ratio, diff / bound);
    ++items;
  }
};

TEST(Bounds, OfAPlaneFromTheOriginHoldForFloatArithmetic) {
  Random r;
  Largest depth, color;
  for (int n = 0; n < 20000; ++n) {
    const WindowTriangle<double> t = random_triangle(r);
    if (std::abs(unsnapped_area(t)) < 1e-2 || (unsnapped_area(t) > 0) != t.front) continue;
    for_pixels(t, r, [&](int x, int y, const glm::dvec3& w) {
      const PlaneBounds bounds = bounds_from_origin(t, x, y);
      std::array<float, 3> z, over_w, inv_w;
      double exact_z = 0, exact_over_w = 0, exact_inv_w = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        z[i] = static_cast<float>(t.v[i].p_win.z);
        inv_w[i] = static_cast<float>(t.v[i].inv_w);
        over_w[i] = static_cast<float>(t.v[i].color.r) * inv_w[i];
        exact_z += w[static_cast<int>(i)] * t.v[i].p_win.z;
        exact_over_w += w[static_cast<int>(i)] * t.v[i].color.r * t.v[i].inv_w;
        exact_inv_w += w[static_cast<int>(i)] * t.v[i].inv_w;
      }
      depth.add(std::abs(from_origin(t, z, x, y) - exact_z) / kU, bounds.depth);
      const float c = from_origin(t, over_w, x, y) * (1.0f / from_origin(t, inv_w, x, y));
      color.add(std::abs(c - exact_over_w / exact_inv_w) / kU, bounds.color.r);
    });
  }
  RecordProperty("depth", std::to_string(depth.ratio));
  RecordProperty("color", std::to_string(color.ratio));
  EXPECT_GT(depth.items, 50000u);
  for (const auto& [largest, stage] : {std::pair(depth, Stage::depth), std::pair(color, Stage::attributes)}) {
    const Tolerance& row = tolerance(Profile::opengl, stage);
    EXPECT_LE(largest.ratio, row.factor) << name_of(row) << " is not sound";
    EXPECT_GE(largest.ratio, row.factor / 20) << name_of(row) << " is absurdly loose";
  }
}

TEST(Bounds, OfAMeanHoldForFloatArithmetic) {
  Random r;
  Largest largest;
  for (int n = 0; n < 20000; ++n) {
    const WindowTriangle<double> t = random_triangle(r);
    if (std::abs(unsnapped_area(t)) < 1e-2 || (unsnapped_area(t) > 0) != t.front) continue;
    for_pixels(t, r, [&](int x, int y, const glm::dvec3& w) {
      const Vec4<double> bound = bounds_of_mean(t, x, y);
      glm::vec3 q;
      glm::dvec3 exact_q;
      for (int i = 0; i < 3; ++i) {
        const double inv_w = t.v[static_cast<std::size_t>(i)].inv_w;
        q[i] = static_cast<float>(w[i]) * static_cast<float>(inv_w);
        exact_q[i] = w[i] * inv_w;
      }
      const float reciprocal = 1.0f / (q.x + q.y + q.z);
      const float k1 = q.y * reciprocal, k2 = q.z * reciprocal;
      for (int c = 0; c < 3; ++c) {
        const auto corner = [&](std::size_t i) { return static_cast<float>(t.v[i].color[c]); };
        const float mean = corner(0) + k1 * (corner(1) - corner(0)) + k2 * (corner(2) - corner(0));
        double exact = 0;
        for (int i = 0; i < 3; ++i) exact += exact_q[i] * t.v[static_cast<std::size_t>(i)].color[c];
        largest.add(std::abs(mean - exact / (exact_q.x + exact_q.y + exact_q.z)) / kU, bound[c]);
      }
    });
  }
  RecordProperty("mean", std::to_string(largest.ratio));
  EXPECT_LE(largest.ratio, 12);
  EXPECT_LE(largest.ratio, tolerance(Profile::exact, Stage::attributes).factor) << "exact.attributes is not sound";
  EXPECT_GE(largest.ratio, tolerance(Profile::exact, Stage::attributes).factor / 20)
      << "exact.attributes is absurdly loose";
}

// Corners are floats, triangles of all shapes down to slivers.
TEST(Bounds, OfDepthsInFloatHold) {
  using Bound = double (*)(const WindowCorners&, glm::dvec2);
  struct Case {
    test::FloatDepth way;
    Bound bound;
    double least;  // of the largest share of the bound
  };
  for (const Case& of : {Case{test::FloatDepth::edge_functions, error_by_edge_functions, 0.25},
                         Case{test::FloatDepth::plane, error_by_plane, 0.2},
                         Case{test::FloatDepth::edge_equations, error_by_edge_equations, 0.05}}) {
    Random r;
    Largest largest;
    for (int n = 0; n < 40000; ++n) {
      const WindowTriangle<double> t = random_triangle(r);
      if (std::abs(unsnapped_area(t)) < 1e-3 || (unsnapped_area(t) > 0) != t.front) continue;
      const WindowCorners corners = {t.v[0].p_win, t.v[1].p_win, t.v[2].p_win};
      for_pixels(t, r, [&](int x, int y, const glm::dvec3& w) {
        const glm::dvec2 p(x + 0.5, y + 0.5);
        const double exact = w.x * corners[0].z + w.y * corners[1].z + w.z * corners[2].z,
                     depth = static_cast<double>(test::depth_in_float(of.way, corners, glm::vec2(p)));
        if (std::isfinite(depth)) largest.add(std::abs(depth - exact) / kU, of.bound(corners, p));
      });
    }
    std::printf("way %d: %.3f of the bound\n", static_cast<int>(of.way), largest.ratio);
    EXPECT_GT(largest.items, 50000u);
    EXPECT_LE(largest.ratio, 1) << static_cast<int>(of.way);
    EXPECT_GE(largest.ratio, of.least) << static_cast<int>(of.way) << ": loose";
  }
  const WindowCorners none = {glm::dvec3(1, 1, 0.5), glm::dvec3(3, 3, 0.5), glm::dvec3(5, 5, 0.5)};
  EXPECT_EQ(error_by_edge_functions(none, {3, 3}), kInfinite) << "no area";
}

// The bound of a piece within the window, wherever the piece lies, is no less than that of any such triangle.
TEST(Bounds, OfPiecesAreTheLargest) {
  using enum Conventions::DepthArithmetic;
  Random r;
  const glm::dvec2 window(256, 192);
  std::size_t pieces = 0;
  for (int n = 0; n < 20000; ++n) {
    WindowTriangle<double> t = random_triangle(r);
    const double rise = std::exp2(r.in(-12, 0));  // nearly level ones, too
    for (auto& v : t.v) v.p_win.z = 0.5 + (v.p_win.z - 0.5) * rise;
    const WindowCorners corners = {t.v[0].p_win, t.v[1].p_win, t.v[2].p_win};
    double longest = 0;
    bool is_within = true;
    for (std::size_t i = 0; i < 3; ++i) {
      longest = std::max(longest, glm::distance(glm::dvec2(corners[i]), glm::dvec2(corners[(i + 1) % 3])));
      is_within &= corners[i].x >= 0 && corners[i].y >= 0 && corners[i].x <= window.x && corners[i].y <= window.y;
    }
    const double altitude = std::abs(unsnapped_area(t)) / longest;
    if (!is_within || altitude < 1e-2) continue;
    ++pieces;
    const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double slope = glm::length(glm::dvec2(normal)) / std::abs(normal.z);
    for_pixels(t, r, [&](int x, int y, const glm::dvec3& w) {
      if (std::min({w.x, w.y, w.z}) < 0) return;
      for (const auto arithmetic : {in_float, in_float_stepped, in_float_stepped_edges, in_float_from_origin})
        EXPECT_LE(depth_error(arithmetic, corners, {x + 0.5, y + 0.5}, kNoSides),
                  depth_error_of_pieces(arithmetic, altitude, slope, window, kNoSides));
    });
  }
  EXPECT_GT(pieces, 3000u);
  EXPECT_LT(100 * depth_error_of_pieces(in_float, 0.05, 1e-4, window, kNoSides),
            depth_error_of_pieces(in_float, 0.05, 1, window, kNoSides));
  EXPECT_EQ(depth_error_of_pieces(in_double, 0, 1, window, kNoSides), 0);
  EXPECT_EQ(depth_error_of_pieces(in_float, 0, 1, window, kNoSides), kInfinite);
}

// Weights in float within blocks of 4 x 4 pixels, in triangles where the weights' numerators and their sum change by at
// most half of the least 1/w within a block.
TEST(Bounds, OfAMeanHoldForFloatArithmeticWithinBlocks) {
  Random r;
  Largest largest;
  for (int n = 0; n < 20000; ++n) {
    const WindowTriangle<double> t = random_triangle(r);
    if (std::abs(unsnapped_area(t)) < 1e-2 || (unsnapped_area(t) > 0) != t.front) continue;
    const glm::dvec3 inv_w(t.v[0].inv_w, t.v[1].inv_w, t.v[2].inv_w);
    const auto values = [&](int x, int y) {  // q_1, q_2, and the sum of all three
      const glm::dvec3 q = weights(t, x, y) * inv_w;
      return glm::dvec3(q.y, q.z, q.x + q.y + q.z);
    };
    const glm::dvec3 at_0 = values(0, 0), slope_x = values(1, 0) - at_0, slope_y = values(0, 1) - at_0;
    const glm::dvec3 change = 3.0 * (glm::abs(slope_x) + glm::abs(slope_y));
    if (std::max({change.x, change.y, change.z}) > std::min({inv_w.x, inv_w.y, inv_w.z}) / 2) continue;
    for_pixels(t, r, [&](int x, int y, const glm::dvec3&) {
      const glm::vec3 first(values(x & ~3, y & ~3));
      const glm::vec3 q =
          first + (static_cast<float>(x & 3) * glm::vec3(slope_x) + static_cast<float>(y & 3) * glm::vec3(slope_y));
      const float reciprocal = 1.0f / q.z, k1 = q.x * reciprocal, k2 = q.y * reciprocal;
      const glm::dvec3 exact_q = values(x, y);
      const Vec4<double> bound = bounds_of_mean(t, x, y);
      for (int c = 0; c < 3; ++c) {
        const glm::dvec3 corner(t.v[0].color[c], t.v[1].color[c], t.v[2].color[c]);
        const auto float_of = [&](int i) { return static_cast<float>(corner[i]); };
        const float mean = float_of(0) + k1 * (float_of(1) - float_of(0)) + k2 * (float_of(2) - float_of(0));
        const double exact =
            corner.x + (exact_q.x * (corner.y - corner.x) + exact_q.y * (corner.z - corner.x)) / exact_q.z;
        largest.add(std::abs(mean - exact) / kU, bound[c]);
      }
    });
  }
  RecordProperty("mean", std::to_string(largest.ratio));
  EXPECT_GT(largest.items, 50000u);
  EXPECT_LE(largest.ratio, tolerance(Profile::exact, Stage::attributes).factor) << "exact.attributes is not sound";
  EXPECT_GE(largest.ratio, tolerance(Profile::exact, Stage::attributes).factor / 20) << "and absurdly loose";
}

// Room for float sums within blocks is left where weights change little there, and only there.
TEST(Bounds, OfAMeanCountBlocksWhereWeightsChangeLittle) {
  const auto bound_beyond_weights = [](double side) {
    WindowTriangle<double> t = triangle_of({{{0.5, 0.5, 0}, {0.5 + side, 0.5, 0}, {0.5, 0.5 + side, 0}}});
    for (std::size_t i = 0; i < 3; ++i) t.v[i].color = Vec4<double>(i == 1 ? 1 : 0, 0, 0, 1);
    return bounds_of_mean(t, 0, 0).r;  // at corner 0, where corner 1's share is 0
  };
  EXPECT_NEAR(bound_beyond_weights(6), 0.4 * 3 / 6, 1e-5);
  EXPECT_NEAR(bound_beyond_weights(60), 0.4 * 3 / 60, 1e-5);
  EXPECT_LT(bound_beyond_weights(5.9), 1e-5);
}

TEST(Bounds, OfAFlatTriangleAreThoseOfItsValue) {
  WindowTriangle<double> t = triangle_of({{{0.5, 0.5, 0.5}, {8.5, 0.5, 0.5}, {0.5, 8.5, 0.5}}});
  for (auto& v : t.v) v.color = {0.25, 0.5, 1, 1};
  EXPECT_NEAR(bounds_from_origin(t, 3, 3).depth, 1.5, 1e-9) << "1 and the value";
  for (int c = 0; c < 4; ++c) {
    EXPECT_NEAR(bounds_from_origin(t, 3, 3).color[c], 2 * t.v[0].color[c], 1e-9) << "the value's and 1/w's";
    EXPECT_LE(bounds_of_mean(t, 3, 3)[c], 2 * t.v[0].color[c]);
    EXPECT_GT(bounds_of_mean(t, 3, 3)[c], 0);
  }
}

TEST(Bounds, OfOpenGLsPlanesLetWhatIsBelowNormalNumbersBecomeZero) {
  WindowTriangle<double> t = triangle_of({{{0.5, 0.5, 0.5}, {8.5, 0.5, 0.5}, {0.5, 8.5, 0.5}}});
  for (auto& v : t.v) v.color = {0x1p-127, 0x1p-110, 0, 1};
  const Vec4<double> bound =
      tolerance(Profile::opengl, Stage::attributes).factor * kU * bounds_from_origin(t, 3, 3).color;
  EXPECT_GT(bound.r, 0x1p-127) << "flushed";
  EXPECT_LT(bound.g, 0x1p-110) << "a number whose products are normal is not";
}

TEST(Bounds, ARoundingBelowNormalNumbersIsAbsolute) {
  const Roundings ours{2}, mesas{2, kFlushedUnderflow};
  EXPECT_EQ(ours(0), 0) << "nothing is rounded";
  EXPECT_EQ(ours(1), 2 * kU);
  EXPECT_GE(ours(0x1p-140), 0x1p-149);
  EXPECT_LT(ours(0x1p-140), 0x1.01p-149);
  EXPECT_GE(mesas(0x1p-140), 0x1p-125);
  const Vec4<double> color(0x1p-70), none(0);
  const Environed product = environ_error(TextureFormat::rgba, {}, color, none, color, none, {1});
  EXPECT_EQ(product.color.r, 0x1p-140);
  EXPECT_GE(product.error.r, kGradualUnderflow);
}

// On the edge from corner 0 to corner 2, corner 1's share is 0, and what double makes of it some 2^-52.
TEST(Bounds, OfAMeanLeaveRoomForAShareThatIsNearlyZero) {
  WindowTriangle<double> t = triangle_of({{{0.5, 0.5, 0}, {6.5, 2.5, 0}, {4.5, 4.5, 0}}});
  for (std::size_t i = 0; i < 3; ++i) t.v[i].color = Vec4<double>(i == 1 ? 1 : 0, 0, 0, 1);
  EXPECT_GT(kU * bounds_of_mean(t, 2, 2).r, 0x1p-52);
  EXPECT_LT(kU * bounds_of_mean(t, 2, 2).r, 0x1p-45) << "2^-52 of 1 and slopes of 1/2 over 128 pixels: 2^-46";
}

TEST(Bounds, GrowWithTheGradientAndTheDistanceFromTheOrigin) {
  const auto at = [](double offset, double slope) {
    return bounds_from_origin(
               triangle_of({{{offset, offset, 0}, {offset + 8, offset, slope}, {offset, offset + 8, 0}}}),
               static_cast<int>(offset) + 1, static_cast<int>(offset) + 1)
        .depth;
  };
  EXPECT_GT(at(100, 0.5), at(0, 0.5));
  EXPECT_GT(at(100, 1), 1.5 * at(100, 0.5));
  // 1 + 1 + 1/8 (101 + 108) and the gradient's own error.
  EXPECT_GT(at(100, 1), 2 + 209 / 8.0);
  EXPECT_LT(at(100, 1), 4 * (2 + 209 / 8.0));
}

// The third corner is midway between the others: the area is 0, or 2^-20 of a pixel, of terms of 85.
TEST(Bounds, AreInfiniteWhereTheAreaMayVanishInFloat) {
  const auto bound = [](double off) {
    return bounds_from_origin(
        triangle_of(
            {{{16.06640625, 32.9140625, 0}, {9.1640625, 57.51953125, 0}, {12.615234375 + off, 45.216796875, 0}}}),
        14, 38);
  };
  for (const double off : {0.0, 0x1p-22}) {
    EXPECT_EQ(bound(off).depth, kInf) << off;
    EXPECT_EQ(bound(off).color, Vec4<double>(kInf)) << off;
  }
  EXPECT_TRUE(std::isfinite(bound(0x1p-10).depth));
}

TEST(Bounds, DoNotDependOnTheOrderOfTheCorners) {
  Random r;
  for (int n = 0; n < 100; ++n) {
    WindowTriangle<double> t = random_triangle(r), turned = t;
    if (std::abs(unsnapped_area(t)) < 1 || (unsnapped_area(t) > 0) != t.front) continue;
    std::rotate(turned.v.begin(), turned.v.begin() + 1, turned.v.end());
    const PlaneBounds a = bounds_from_origin(t, 100, 100), b = bounds_from_origin(turned, 100, 100);
    EXPECT_LT(a.depth, 2.5 * b.depth);
    EXPECT_LT(b.depth, 2.5 * a.depth);
  }
}

TEST(Bounds, OfUnsnappedCornersThatTurnTheOtherWayUseTheSnapped) {
  // Clockwise by 2^-12 pixel, snapped counter-clockwise: as the pipeline's own planes do (stages.h, 6).
  WindowTriangle<double> t = triangle_of({{{10, 10, 0.25}, {40, 10, 0.5}, {25, 10 - 0x1p-12, 0.75}}}, {1, 1, 1});
  t.v[2].snapped.y += 1;
  t.front = true;
  const Vec4<double> bound = bounds_of_mean(t, 20, 9);
  EXPECT_LT(bound.r, 1e5) << "through the unsnapped corners weight and condition would be 16 times larger each";
  const exact::Barycentric exactly(t, 64, 64);
  const auto b = exactly.at(20, 9);
  const double mean = static_cast<double>(b[0]);  // red is corner 0's weight
  EXPECT_GE(bound.r, 0.2 * std::abs(mean));
}

TEST(Magnitude, SumsTheTermsWithoutTheirSigns) {
  glm::dmat4 m(0);
  m[0] = {1, -2, 3, 0};
  m[1] = {-4, 5, -6, 0};
  m[3] = {7, -8, 9, -1};
  EXPECT_EQ(magnitude(m, {2, 3, 100, -1}), glm::dvec4(2 + 12 + 7, 4 + 15 + 8, 6 + 18 + 9, 1));
}

TEST(Magnitude, OfANormalIsRelative) {
  EXPECT_NEAR(normal_magnitude(glm::dmat3(5), {0, 0.6, 0.8}), 1, 1e-12);
  glm::dmat3 m(1);
  m[0] = {1, 1, 0};
  m[1] = {-1, -0.5, 0};
  // N n = (0, 0.5, 0), of the sums 2 and 1.5.
  EXPECT_NEAR(normal_magnitude(m, {1, 1, 0}), 2.5 / 0.5, 1e-12);
}

}  // namespace
}  // namespace plumbline::check

// Stage 3. Colours red, green and blue of the three corners tell how far along an edge a cut lies.
#include "pipeline/geometry.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace plumbline::pipeline {
namespace {

using Corners = std::array<glm::vec4, 3>;
/// A corner, its attributes the colour alone.
struct Cut {
  glm::vec4 p_clip, color;
  bool cut;
};
using Cuts = std::vector<Cut>;
constexpr std::array<const char*, 6> kNames = {"right", "left", "top", "bottom", "near", "far"};

/// The corners of what clip_it() leaves of the triangle; empty: nothing is left.
template <class Clip>
Cuts polygon_of(const Corners& p, Clip clip_it, Shading shading = Shading::gouraud) {
  const Vertex<float> vertices[3] = {{{}, p[0], {}}, {{}, p[1], {}}, {{}, p[2], {}}};
  Attributes attributes[3] = {};
  attributes[0].color() = {1, 0, 0, 1}, attributes[1].color() = {0, 1, 0, 0.5f}, attributes[2].color() = {0, 0, 1, 0};
  Draw draw;
  draw.shading = shading;
  const DrawInput input{&draw, Topology::triangles, false, false, {}};
  Polygon polygon = assemble(input, {0, 1, 2}, vertices, attributes);
  clip_it(input, polygon);
  Cuts out;
  for (const ClipVertex& v : polygon.corners) out.push_back({v.p_clip, v.attributes.color(), v.cut});
  return out;
}
Cuts clipped(const Corners& p, Shading shading = Shading::gouraud) { return polygon_of(p, clip, shading); }
Cuts clipped_at(std::span<const Vec4<float>> planes, const Corners& p) {
  return polygon_of(p, [&](const DrawInput&, Polygon& polygon) { clip_at(planes, polygon); });
}

bool same(const Cuts& a, const Cuts& b) {
  const auto equal = [](const Cut& v, const Cut& w) {
    return v.p_clip == w.p_clip && v.color == w.color && v.cut == w.cut;
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), equal);
}

void expect_polygon(const Cuts& is, const Cuts& expected) {
  ASSERT_EQ(is.size(), expected.size());
  for (std::size_t i = 0; i < is.size(); ++i) {
    EXPECT_EQ(is[i].p_clip, expected[i].p_clip) << "vertex " << i;
    EXPECT_EQ(is[i].color, expected[i].color) << "vertex " << i;
    EXPECT_EQ(is[i].cut, expected[i].cut) << "vertex " << i;
  }
}

float distance_to(const glm::vec4& plane, const glm::vec4& p) {
  return ((p.x * plane.x + p.y * plane.y) + p.z * plane.z) + p.w * plane.w;
}

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float operator()(float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(engine_); }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  glm::vec4 point() { return {(*this)(-2, 2), (*this)(-2, 2), (*this)(-2, 2), (*this)(-0.2f, 2)}; }

 private:
  std::mt19937 engine_;
};

TEST(PipelineClip, TheViewVolumeInTheDriversOrder) {
  const auto planes = view_volume();
  // A point that violates each plane and no other, in the order right, left, top, bottom, near, far.
  const glm::vec4 beyond[] = {{2, 0, 0, 1}, {-2, 0, 0, 1}, {0, 2, 0, 1}, {0, -2, 0, 1}, {0, 0, -2, 1}, {0, 0, 2, 1}};
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(glm::dot(planes[k], beyond[i]), i == k ? -1 : k == (i ^ 1) ? 3 : 1);
  }
}

TEST(PipelineClip, InsideStaysAsItIs) {
  const Corners p = {{{1, -1, 1, 1}, {-2, 2, -2, 2}, {0, 0.1f, 0.25f, 0.5f}}};  // two corners of the volume itself
  expect_polygon(clipped(p),
                 {{p[0], {1, 0, 0, 1}, false}, {p[1], {0, 1, 0, 0.5f}, false}, {p[2], {0, 0, 1, 0}, false}});
}

TEST(PipelineClip, EachPlaneCutsOneCornerOff) {
  for (int plane = 0; plane < 6; ++plane) {
    SCOPED_TRACE(kNames[static_cast<std::size_t>(plane)]);
    const int axis = plane / 2;
    const float side = plane == 0 || plane == 2 || plane == 5 ? 1.0f : -1.0f;
    glm::vec4 a(0, 0, 0, 1), b(0, 0, 0, 1), out(0, 0, 0, 1), cut_a(0, 0, 0, 1), cut_b(0, 0, 0, 1);
    a[(axis + 1) % 3] = 0.5f;
    b[(axis + 1) % 3] = -0.5f;
    out[axis] = 4 * side;
    cut_a[axis] = cut_b[axis] = side;
    cut_a[(axis + 1) % 3] = 0.375f;  // a quarter of the way from a to out
    cut_b[(axis + 1) % 3] = -0.375f;
    expect_polygon(clipped({{a, b, out}}), {{a, {1, 0, 0, 1}, false},
                                            {b, {0, 1, 0, 0.5f}, false},
                                            {cut_b, {0, 0.75f, 0.25f, 0.375f}, true},
                                            {cut_a, {0.75f, 0, 0.25f, 0.75f}, true}});
    // Two corners out: a triangle is left, of the one inside and two cuts.
    expect_polygon(clipped({{out, a, {out.x, out.y, out.z, 1}}}), {{cut_a, {0.25f, 0.75f, 0, 0.625f}, true},
                                                                   {a, {0, 1, 0, 0.5f}, false},
                                                                   {cut_a, {0, 0.75f, 0.25f, 0.375f}, true}});
  }
}

TEST(PipelineClip, WhollyBeyondOnePlaneLeavesNothing) {
  for (std::size_t plane = 0; plane < 6; ++plane) {
    const glm::vec4 outward = -glm::vec4(glm::vec3(view_volume()[plane]), 0);
    Corners p = {{{0.1f, 0.2f, 0.3f, 1}, {0.3f, 0.1f, 0.2f, 1}, {0.2f, 0.3f, 0.1f, 1}}};
    for (glm::vec4& corner : p) corner += 2.0f * outward;
    EXPECT_TRUE(clipped(p).empty()) << kNames[plane];
  }
  EXPECT_TRUE(clipped({{{0, 0, 0, -1}, {1, 0, 0, -1}, {0, 1, 0, -2}}}).empty()) << "behind the eye";
  // Beyond different planes, and past the volume's corner.
  EXPECT_TRUE(clipped({{{3, 0, 0, 1}, {0, 3, 0, 1}, {3, 3, 0, 1}}}).empty());
}

TEST(PipelineClip, AcrossTheEyePlaneTheNearPlaneCuts) {
  // w from 2 down to -2 beside the eye: what lies behind it must not come back mirrored.
  const Cuts p = clipped({{{0, -1, 1, 2}, {0.5f, -1, 1, 2}, {0, 0, -3, -2}}});
  ASSERT_EQ(p.size(), 4u);
  for (const auto& v : p) EXPECT_GE(v.p_clip.w, 0.25f);
}

TEST(PipelineClip, AllSixPlanesLeaveNineCorners) {
  // The plane x + y + z = 0 meets the cube in a hexagon; the triangle's own edges cut three of its corners off.
  const Cuts p = clipped({{{1.75f, -1.75f, 0, 1}, {0, 1.75f, -1.75f, 1}, {-1.75f, 0, 1.75f, 1}}});
  ASSERT_EQ(p.size(), 9u);
  glm::vec3 turning(0);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_TRUE(p[i].cut);
    EXPECT_NEAR(std::max({std::abs(p[i].p_clip.x), std::abs(p[i].p_clip.y), std::abs(p[i].p_clip.z)}), 1, 1e-6);
    const auto at = [&](std::size_t k) { return glm::vec3(p[k % 9].p_clip); };
    const glm::vec3 turn = glm::cross(at(i + 1) - at(i), at(i + 2) - at(i + 1));
    EXPECT_GT(glm::dot(turn, glm::vec3(1, 1, 1)), 0) << "convex, wound as the triangle was";
    turning += turn;
  }
  EXPECT_GT(turning.x, 0);
}

TEST(PipelineClip, WhatIsLeftLiesInsideAndOnTheTriangle) {
  Random random(1);
  int cut = 0;
  for (int i = 0; i < 20000; ++i) {
    const Corners p = {{random.point(), random.point(), random.point()}};
    const Cuts polygon = clipped(p);
    ASSERT_TRUE(polygon.empty() || (polygon.size() >= 3 && polygon.size() <= 9));
    for (const auto& v : polygon) {
      for (const auto& plane : view_volume()) ASSERT_GE(distance_to(plane, v.p_clip), -4e-6f);
      if (!v.cut) continue;
      ++cut;
      // Red, green and blue are the barycentric coordinates, and the alpha goes by them too.
      const glm::vec4 there = v.color.r * p[0] + v.color.g * p[1] + v.color.b * p[2];
      for (int k = 0; k < 4; ++k) ASSERT_NEAR(there[k], v.p_clip[k], 4e-6f);
      ASSERT_NEAR(v.color.a, v.color.r + v.color.g / 2, 1e-6f);
    }
  }
  EXPECT_GT(cut, 10000);
}

TEST(PipelineClip, ACutIsTakenFromTheNearerEnd) {
  Random random(2);
  int other_end_differs = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::vec4 plane = view_volume()[static_cast<std::size_t>(i % 6)];
    glm::vec4 inside, outside;
    do inside = random.point();
    while (distance_to(plane, inside) < 0);
    do outside = random.point();
    while (distance_to(plane, outside) >= 0);
    const float d_in = distance_to(plane, inside), d_out = distance_to(plane, outside);
    const auto from = [](glm::vec4 a, float d_a, glm::vec4 b, float d_b) { return a + d_a / (d_a - d_b) * (b - a); };
    const glm::vec4 from_inside = from(inside, d_in, outside, d_out), from_outside = from(outside, d_out, inside, d_in);
    const glm::vec4 expected = d_in <= -d_out ? from_inside : from_outside;
    other_end_differs += from_inside != from_outside;
    for (const Corners& p : {Corners{{inside, outside, inside}}, Corners{{outside, inside, outside}}}) {
      const Cuts cut = clipped_at(std::span(&plane, 1), p);
      ASSERT_EQ(cut.size(), p[0] == inside ? 4u : 3u);
      for (const auto& v : cut) {
        if (v.cut) {
          ASSERT_EQ(v.p_clip, expected) << "d_in " << d_in << ", d_out " << d_out;
        }
      }
    }
  }
  EXPECT_GT(other_end_differs, 500);
}

TEST(PipelineClip, ATieIsTakenFromTheInsideEnd) {
  // At x = w: 0.5 and 1.5 are as far from it. By rounding the two ends' y and z may differ in the last place.
  Random random(3);
  int other_end_differs = 0;
  for (int i = 0; i < 1000; ++i) {
    const glm::vec4 inside(0.5f, random(-1, 1), random(-1, 1), 1), outside(1.5f, random(-1, 1), random(-1, 1), 1);
    const glm::vec4 from_inside = inside + 0.5f * (outside - inside),
                    from_outside = outside + 0.5f * (inside - outside);
    other_end_differs += from_inside != from_outside;
    for (const Corners& p : {Corners{{inside, outside, inside}}, Corners{{outside, inside, outside}}}) {
      for (const auto& v : clipped(p)) {
        if (v.cut) {
          ASSERT_EQ(v.p_clip, from_inside);
        }
      }
    }
  }
  EXPECT_GT(other_end_differs, 100);
}

TEST(PipelineClip, NeighboursCutTheirSharedEdgeAtTheSamePoints) {
  Random random(4);
  int cuts = 0;
  for (int i = 0; i < 5000; ++i) {
    const glm::vec4 a = random.point(), b = random.point(), c = random.point(), d = random.point();
    // On the shared edge no cut has any of the third corner's colour, blue.
    const auto on_edge = [](const Cuts& polygon) {
      std::vector<glm::vec4> points;
      for (const auto& v : polygon) {
        if (v.cut && v.color.b == 0) points.push_back(v.p_clip);
      }
      return points;
    };
    std::vector<glm::vec4> one = on_edge(clipped({{a, b, c}})), other = on_edge(clipped({{b, a, d}}));
    if (one.size() != other.size()) {
      // Only where one of them is wholly beyond a plane, or a cut fell on the volume's edge.
      ASSERT_TRUE(one.empty() || other.empty());
      continue;
    }
    std::reverse(other.begin(), other.end());
    ASSERT_EQ(one, other);
    cuts += static_cast<int>(one.size());
  }
  EXPECT_GT(cuts, 2000);
}

TEST(PipelineClip, ThePlanesInTheirOrder) {
  // Beyond right and top alike, the cut of the right plane is cut again by the top one.
  Random random(5);
  int order_shows = 0;
  for (int i = 0; i < 2000; ++i) {
    const Corners p = {{random.point(), random.point(), random.point()}};
    const Cuts is = clipped(p);
    ASSERT_TRUE(same(is, clipped_at(view_volume(), p)));
    std::vector<Vec4<float>> turned(view_volume().begin(), view_volume().end());
    std::reverse(turned.begin(), turned.end());
    order_shows += !same(is, clipped_at(turned, p));
  }
  EXPECT_GT(order_shows, 200);
  // By hand. Cut at x = 1 first (t = 1/4, twice), what is left lies below y = 1. At y = 1 first, it would be cut twice.
  expect_polygon(clipped({{{0, 0, 0, 1}, {4, 2, 0, 1}, {0, 0.5f, 0, 1}}}),
                 {{{0, 0, 0, 1}, {1, 0, 0, 1}, false},
                  {{1, 0.5f, 0, 1}, {0.75f, 0.25f, 0, 0.875f}, true},
                  {{1, 0.875f, 0, 1}, {0, 0.25f, 0.75f, 0.125f}, true},
                  {{0, 0.5f, 0, 1}, {0, 0, 1, 0}, false}});
}

TEST(PipelineClip, PlanesThatNoVertexViolatesAreLeftAlone) {
  // A cut's rounding may put it beyond a plane that it should lie on: it is not cut again there.
  Random random(6);
  int shows = 0;
  for (int i = 0; i < 20000; ++i) {
    Corners p;
    for (glm::vec4& corner : p) {
      const float w = random(0.25f, 2);
      corner = {w * random(-3, 3), w, w * random(-0.9f, 0.9f), w};  // on the top plane, but for its last places
      corner.y = random.below(2) == 0 ? w : std::nextafter(w, 0.0f);
    }
    std::vector<Vec4<float>> violated;
    for (const auto& plane : view_volume()) {
      if (std::any_of(p.begin(), p.end(), [&](const glm::vec4& v) { return distance_to(plane, v) < 0; })) {
        violated.push_back(plane);
      }
    }
    const Cuts is = clipped(p);
    ASSERT_TRUE(same(is, clipped_at(violated, p)));
    for (const auto& v : is) shows += distance_to(view_volume()[2], v.p_clip) < 0;
  }
  EXPECT_GT(shows, 10);
}

TEST(PipelineClip, AlongTheVolumesEdgesNoMoreThanNineCorners) {
  Random random(7);
  std::size_t most = 0;
  for (int i = 0; i < 100000; ++i) {
    Corners p;
    const float sides[2] = {random.below(2) == 0 ? 1.0f : -1.0f, random.below(2) == 0 ? 1.0f : -1.0f};
    for (glm::vec4& corner : p) {
      const float w = random(0.1f, 2);
      const auto nearly = [&](float side) {
        return side * (w + static_cast<float>(random.below(7) - 3) * w * 0x1p-23f);
      };
      corner = {w * random(-3, 3), nearly(sides[0]), nearly(sides[1]), w};
    }
    most = std::max(most, clipped(p).size());
  }
  EXPECT_GE(most, 7u);
  EXPECT_LE(most, 9u);
}

TEST(PipelineClip, OnAPlaneIsInside) {
  const Cuts p = clipped({{{1, 0, 0, 1}, {1, 0.5f, 0, 1}, {1, 0, 0.5f, 1}}});
  ASSERT_EQ(p.size(), 3u);
  for (const auto& v : p) EXPECT_FALSE(v.cut);
  // A corner on the plane that the others are beyond: not wholly outside, but a polygon of one point only.
  for (const auto& v : clipped({{{1, 0, 0, 1}, {2, 0.5f, 0, 1}, {2, 0, 0.5f, 1}}})) EXPECT_EQ(v.p_clip.x, 1);
}

TEST(PipelineClip, ACornerOnThePlaneIsKeptAndCutAtTheSamePlace) {
  const glm::vec4 on(1, 0, 0, 1), out(3, 1, 0, 1), in(0, 0.5f, 0, 1);
  expect_polygon(clipped_at(view_volume().first<1>(), {{on, out, in}}),
                 {{on, {1, 0, 0, 1}, false},
                  {on, {1, 0, 0, 1}, true},
                  {{1, 0.66666667f, 0, 1}, {0, 0.33333334f, 1 - 0.33333334f, 0.16666667f}, true},
                  {in, {0, 0, 1, 0}, false}});
}

TEST(PipelineClip, BeyondAPlaneByALastPlaceIsWhollyOutside) {
  // Cut at the sides first, roundings would bring some cuts back inside of the top plane.
  Random random(8);
  int returns = 0;
  for (int i = 0; i < 20000; ++i) {
    Corners p;
    for (glm::vec4& corner : p) {
      const float w = random(0.25f, 2);
      corner = {w * random(-3, 3), std::nextafter(w, 9.0f), w * random(-0.9f, 0.9f), w};
    }
    ASSERT_TRUE(clipped(p).empty());
    for (const auto& v : clipped_at(view_volume().first<2>(), p))
      returns += distance_to(view_volume()[2], v.p_clip) >= 0;
  }
  EXPECT_GT(returns, 10);
}

TEST(PipelineClip, FlatTakesTheLastCornersColour) {
  const glm::vec4 blue(0, 0, 1, 0);
  const Cuts p = clipped({{{0, 0, 0, 1}, {4, 0, 0, 1}, {0, 0.5f, 0, 1}}}, Shading::flat);
  ASSERT_EQ(p.size(), 4u);
  for (const auto& v : p) EXPECT_EQ(v.color, blue);
}

TEST(PipelineClip, WhatIsNotFiniteIsDropped) {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  for (float bad : {infinity, -infinity, nan}) {
    for (int corner = 0; corner < 3; ++corner) {
      for (int k = 0; k < 4; ++k) {
        Corners p = {{{0, 0, 0, 1}, {0.5f, 0, 0, 1}, {0, 0.5f, 0, 1}}};
        p[static_cast<std::size_t>(corner)][k] = bad;
        EXPECT_TRUE(clipped(p).empty()) << bad << " as component " << k << " of corner " << corner;
      }
    }
  }
}

TEST(PipelineClip, AttributesAreCutWithTheColour) {
  const Vertex<float> vertices[] = {{{}, {0, 0, 0, 1}, {}}, {{}, {4, 0, 0, 1}, {}}, {{}, {0, 0.5f, 0, 1}, {}}};
  Attributes attributes[3] = {};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < kAttributes; ++k) attributes[i][k] = glm::vec4(static_cast<float>(10 * i + k));
  }
  Draw draw;
  DrawInput input{&draw, Topology::triangles, false, false, {}};
  Polygon polygon = assemble(input, {0, 1, 2}, vertices, attributes);
  clip(input, polygon);
  ASSERT_EQ(polygon.corners.size(), 4u);
  for (std::size_t k = 0; k < kAttributes; ++k) {
    const auto number = static_cast<float>(k);
    EXPECT_EQ(polygon.corners[0].attributes[k], glm::vec4(number));
    EXPECT_EQ(polygon.corners[1].attributes[k], glm::vec4(number + 2.5f)) << "a quarter of the way";
    EXPECT_EQ(polygon.corners[2].attributes[k], glm::vec4(number + 17.5f));
    EXPECT_EQ(polygon.corners[3].attributes[k], glm::vec4(number + 20));
  }
  // Under flat shading the lit ones are the provoking vertex', the others are not.
  draw.shading = Shading::flat;
  polygon = assemble(input, {2, 1, 0}, vertices, attributes);
  for (const Varying v : kAllVaryings) {
    EXPECT_EQ(polygon.corners[0].attributes[v], attributes[is_lit(v) ? 0 : 2][v]) << name_of(v);
  }
}

TEST(PipelineClipAt, PlanesOfOnesOwn) {
  const Vec4<float> planes[] = {{1, 1, 0, 0}};  // x + y >= 0
  const Cuts p = clipped_at(planes, {{{1, 0, 5, 1}, {0, 1, 5, 1}, {-1, -1, 5, 1}}});
  ASSERT_EQ(p.size(), 4u);
  for (const auto& v : p) EXPECT_GE(v.p_clip.x + v.p_clip.y, -1e-7f);
  const Corners beyond_all = {{{9, 9, 9, 1}, {9, -9, 9, -1}, {-9, 9, 9, 1}}};
  EXPECT_EQ(clipped_at({}, beyond_all).size(), 3u) << "no planes, no cuts";
}

}  // namespace
}  // namespace plumbline::pipeline

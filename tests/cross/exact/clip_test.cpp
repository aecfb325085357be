#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "reference/exact/clip.h"
#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

using Polygon = std::vector<ClipVertex<double>>;

/// Clips a triangle with a red, a green and a blue corner: a cut's colour is its barycentric coordinates.
Polygon clip(glm::dvec4 a, glm::dvec4 b, glm::dvec4 c) {
  return exact::clip_triangle({{{a, {1, 0, 0, 1}, false}, {b, {0, 1, 0, 1}, false}, {c, {0, 0, 1, 1}, false}}});
}

void expect_polygon(const Polygon& is, const Polygon& expected) {
  ASSERT_EQ(is.size(), expected.size());
  for (std::size_t i = 0; i < is.size(); ++i) {
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(is[i].p_clip[k], expected[i].p_clip[k], 1e-15) << "vertex " << i;
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(is[i].color[k], expected[i].color[k], 1e-15) << "vertex " << i;
    EXPECT_EQ(is[i].cut, expected[i].cut) << "vertex " << i;
  }
}

/// A point given for the plane x <= w, moved to plane 0 to 5 (right, left, top, bottom, near, far) by a symmetry of the
/// view volume.
glm::dvec4 turned(glm::dvec4 p, int plane) {
  const int axis = plane / 2;
  const double sign = plane == 0 || plane == 2 || plane == 5 ? 1 : -1;  // right, top and far are the upper ends
  glm::dvec4 out(p.y, p.y, p.y, p.w);
  out[axis] = p.x * sign;
  out[(axis + 1) % 3] = p.y;
  out[(axis + 2) % 3] = p.z;
  return out;
}

TEST(ExactClip, InsideStaysAsItIs) {
  const glm::dvec4 a(-1, -1, -1, 1), b(2, -2, 2, 2), c(0, 0, 0, 1);  // two of them on planes
  expect_polygon(clip(a, b, c), {{a, {1, 0, 0, 1}, false}, {b, {0, 1, 0, 1}, false}, {c, {0, 0, 1, 1}, false}});
}

TEST(ExactClip, EachPlaneCutsOneCornerOff) {
  for (int plane = 0; plane < exact::kPlanes; ++plane) {
    SCOPED_TRACE(plane);
    const auto at = [&](double x, double y, double w) { return turned({x, y, 0, w}, plane); };
    // The corner at x = 3 is cut at x = w = 1: a third of the way from the first, half of that y from the last.
    const double t = 1.0 / 3;
    expect_polygon(clip(at(0, 0, 1), at(3, 0, 1), at(0, 0.5, 1)), {{at(0, 0, 1), {1, 0, 0, 1}, false},
                                                                   {at(1, 0, 1), {1 - t, t, 0, 1}, true},
                                                                   {at(1, 1.0 / 3, 1), {0, t, 1 - t, 1}, true},
                                                                   {at(0, 0.5, 1), {0, 0, 1, 1}, false}});
    // A corner on the plane is inside, and no cut.
    expect_polygon(clip(at(1, 0, 1), at(3, 0.5, 1), at(0, 0.5, 1)), {{at(1, 0, 1), {1, 0, 0, 1}, false},
                                                                     {at(1, 0, 1), {1, 0, 0, 1}, true},
                                                                     {at(1, 0.5, 1), {0, t, 1 - t, 1}, true},
                                                                     {at(0, 0.5, 1), {0, 0, 1, 1}, false}});
    // Two corners off; one of them behind the eye.
    expect_polygon(clip(at(3, 0, -1), at(0, 0, 1), at(3, 0, 1)), {{at(0.6, 0, 0.6), {0.2, 0.8, 0, 1}, true},
                                                                  {at(0, 0, 1), {0, 1, 0, 1}, false},
                                                                  {at(1, 0, 1), {0, 1 - t, t, 1}, true}});
  }
}

TEST(ExactClip, WhollyOutsideLeavesNothing) {
  for (int plane = 0; plane < exact::kPlanes; ++plane)
    EXPECT_TRUE(clip(turned({2, 0, 0, 1}, plane), turned({3, 0, 0, 1}, plane), turned({2, 0.5, 0, 1}, plane)).empty());
  // Outside, but no plane has all three corners outside.
  EXPECT_TRUE(clip({2.5, 0, 0, 1}, {0, 2.5, 0, 1}, {3, 3, 0, 1}).empty());
  // Behind the eye.
  EXPECT_TRUE(clip({0, 0, 0, -1}, {1, 0, 0, -1}, {0, 1, 0, -2}).empty());
}

TEST(ExactClip, AllSixPlanesLeaveNineCorners) {
  // The plane x + y + z = 0 meets the volume in a hexagon, whose every second corner the triangle's sides cut off.
  const double s = 1.8;
  const Polygon nine = clip({s, -s, 0, 1}, {0, s, -s, 1}, {-s, 0, s, 1});
  EXPECT_EQ(nine.size(), 9u);
  for (const auto& v : nine) {
    EXPECT_TRUE(v.cut);
    EXPECT_NEAR(v.p_clip.x + v.p_clip.y + v.p_clip.z, 0, 1e-15);
  }
}

glm::dvec3 doubled_area(const Polygon& polygon) {
  glm::dvec3 sum(0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += glm::cross(glm::dvec3(polygon[i - 1].p_clip - polygon[0].p_clip),
                      glm::dvec3(polygon[i].p_clip - polygon[0].p_clip));
  return sum;
}

TEST(ExactClip, PartsClipToTheWhole) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(-2, 2);
  int cut = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto corner = [&] { return glm::dvec4{uniform(random), uniform(random), uniform(random), 1}; };
    const glm::dvec4 a = corner(), b = corner(), c = corner();
    const glm::dvec4 ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    const Polygon whole = clip(a, b, c);
    const glm::dvec3 area = doubled_area(whole);
    const glm::dvec3 parts = doubled_area(clip(a, ab, ca)) + doubled_area(clip(ab, b, bc)) +
                             doubled_area(clip(ca, bc, c)) + doubled_area(clip(ab, bc, ca));
    ASSERT_LT(glm::distance(area, parts), 1e-12);
    const glm::dvec3 uncut = glm::cross(glm::dvec3(b - a), glm::dvec3(c - a));
    ASSERT_GE(glm::dot(area, uncut), -1e-12) << "the sense of rotation stays";
    for (const auto& v : whole)
      for (int k = 0; k < 3; ++k) ASSERT_LE(std::abs(v.p_clip[k]), v.p_clip.w + 1e-12);
    cut += !whole.empty() && glm::length(area) < 0.99 * glm::length(uncut);
  }
  EXPECT_GT(cut, 5000);
}

TEST(ExactClip, NeighboursShareTheCutToTheBit) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-2, 2);
  int cuts = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto corner = [&] { return glm::dvec4{uniform(random), uniform(random), 0, 1}; };
    const glm::dvec4 in = corner() * glm::dvec4(0.5, 0.5, 0, 1), out = glm::dvec4(1.5, 0, 0, 1);
    // The same edge, run through both ways, the third corner inside.
    const Polygon one = clip(in, out, {0, 0, 0, 1}), other = clip(out, in, {0, 0, 0, 1});
    ASSERT_EQ(one.size(), 4u);
    ASSERT_EQ(other.size(), 4u);
    EXPECT_EQ(one[1].p_clip, other[0].p_clip);
    cuts += one[1].cut && other[0].cut;
  }
  EXPECT_EQ(cuts, 1000);
}

TEST(ExactClip, StageAssemblesNumbersAndShadesFlat) {
  Scene scene = scene_of(4, 4, 0);
  scene.meshes[0].positions.resize(4);
  scene.meshes[0].triangles = {{0, 1, 2}, {3, 3, 3}, {2, 1, 0}};
  scene.draws.push_back(scene.draws[0]);
  scene.draws[1].shading = Shading::flat;
  Records<double> in;
  in.vertices.resize(8);
  in.lit.resize(8);
  for (std::size_t first : {0u, 4u}) {
    in.vertices[first + 0].p_clip = {0, 0, 0, 1};
    in.vertices[first + 1].p_clip = {3, 0, 0, 1};
    in.vertices[first + 2].p_clip = {0, 0.5, 0, 1};
    in.vertices[first + 3].p_clip = {9, 0, 0, 1};  // outside
    for (std::size_t i = 0; i < 4; ++i) in.lit[first + i].color = glm::dvec4(static_cast<double>(first + i) / 8);
  }
  const auto out = run(scene, Stage::clip, in).records.polygons;
  ASSERT_EQ(out.polygons.size(), 4u);
  const std::array<std::uint32_t, 4> primitives = {0, 2, 3, 5};
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(out.polygons[i].primitive, primitives[i]);
    EXPECT_EQ(out.polygons[i].first, 4 * i);
    EXPECT_EQ(out.polygons[i].count, 4u);
  }
  // Gouraud: the cut of the first triangle lies a third from colour 0 to colour 1/8.
  EXPECT_NEAR(out.vertices[1].color.r, 1.0 / 24, 1e-15);
  // Flat: all, cuts too, take the last corner's colour, 6/8 of the first and 4/8 of the second triangle.
  for (std::size_t i = 8; i < 12; ++i) EXPECT_EQ(out.vertices[i].color, glm::dvec4(0.75));
  for (std::size_t i = 12; i < 16; ++i) EXPECT_EQ(out.vertices[i].color, glm::dvec4(0.5));
}

TEST(ExactClip, StageDropsWhatIsNotFinite) {
  Scene scene = scene_of(4, 4, 0);
  scene.meshes[0].positions.resize(3);
  scene.meshes[0].triangles = {{0, 1, 2}};
  Records<double> in;
  in.vertices.resize(3);
  in.lit.resize(3);
  for (auto& v : in.vertices) v.p_clip = {0, 0, 0, 1};
  EXPECT_EQ(run(scene, Stage::clip, in).records.polygons.polygons.size(), 1u);
  for (double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    for (int k = 0; k < 4; ++k) {
      Records<double> broken = in;
      broken.vertices[1].p_clip[k] = bad;
      EXPECT_TRUE(run(scene, Stage::clip, broken).records.polygons.polygons.empty());
    }
  in.lit.pop_back();
  EXPECT_THROW(run(scene, Stage::clip, in), std::invalid_argument);
}

}  // namespace
}  // namespace plumbline

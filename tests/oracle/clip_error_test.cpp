// Errors of clip coordinates in float: a mean of the corners' own, so that a far corner opens nothing near by.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "reference/arithmetic/error_in_float.h"
#include "reference/arithmetic/project.h"
#include "reference/arithmetic/widths.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/pixel_site.h"
#include "scene/scene.h"

namespace plumbline::math {
namespace {

// A floor that begins behind the eye and ends at the horizon, before a near plane at 1e-4.
Scene floor_across_the_eye() {
  Scene scene;
  scene.name = "floor";
  scene.frame.width = 80, scene.frame.height = 60;
  scene.frame.depth = DepthFormat::z32f;
  scene.camera = {{0, 1, 2}, {0, 0.6f, 0}, {0, 1, 0}};
  scene.projection = Perspective{60, 1e-4f, 100};
  Mesh mesh;
  for (const glm::vec2 p : {glm::vec2(-40, 20), {40, 20}, {40, -90}, {-40, -90}}) {
    mesh.positions.emplace_back(p.x, 0, p.y);
    mesh.colors.emplace_back(0.5f, 0.25f + p.y / 400, 1, 1);
  }
  mesh.normals.assign(4, glm::vec3(0, 1, 0));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {mesh};
  Draw draw;
  draw.lit = false;
  scene.draws = {draw};
  return scene;
}

TEST(ClipError, IsAMeanOfTheCornersErrors) {
  const Projected scene = project(floor_across_the_eye());
  const Triangle& t = scene.triangles[0];
  const auto ray = [](const glm::dvec3& v) { return v / v.z; };
  const Corner &near = scene.corners[t.corner[0]], &far = scene.corners[t.corner[2]];
  ASSERT_LT(near.v.z, 0);
  ASSERT_LT(3 * near.size.w, far.size.w);
  double before = 0;
  for (const double share : {0.25, 0.5, 1.0}) {  // of the way to the far corner
    const double error = clip_error(scene, t, ray(glm::mix(near.v, far.v, share))).w;
    EXPECT_GT(error, before);
    before = error;
  }
  EXPECT_NEAR(before, kFloatRounding * t.roundings * far.size.w, 1e-9);
  EXPECT_LT(clip_error(scene, t, ray(glm::mix(near.v, far.v, 0.25))).w, 0.75 * before);
}

TEST(ClipError, LeavesAFloorBehindATinyNearPlaneKnown) {
  Request request;
  request.legal = true;
  const Legal legal = legal_by_boxes(floor_across_the_eye(), request);
  ASSERT_EQ(legal.at(30, 40).size(), 1u);
  EXPECT_EQ(legal.at(30, 40)[0].primitive, kBackground);
  for (const glm::ivec2 p : {glm::ivec2(30, 20), {5, 3}, {70, 25}}) {
    ASSERT_EQ(legal.at(p.x, p.y).size(), 1u) << p.x << ',' << p.y;
    EXPECT_NE(legal.at(p.x, p.y)[0].primitive, kBackground);
  }
}

// v/w and 1/w are stepped in pieces of a cut triangle, too; double rounds nothing.
TEST(ClipError, OfSharesCountsThePiecesOfACutTriangle) {
  Conventions stepped;
  stepped.depth_arithmetic = Conventions::DepthArithmetic::in_float_stepped;
  const Projected scene = project(floor_across_the_eye(), stepped), in_double = project(floor_across_the_eye());
  Triangle t = scene.triangles[0];
  ASSERT_TRUE(t.cut && !t.ahead);
  t.guarded.extent = glm::dvec2(0);  // cut at the frame's sides alone
  const glm::dvec3 d = scene.ray(60, 10);
  const PieceAltitudes wide{1e5, 1e5}, thin{1e4, 1e4}, none{0, 0};
  const double error = shares_error_in_float(scene, t, d, wide, 1e-5);
  EXPECT_GT(error, 80 * kFloatRounding) << "a rounding a column";
  EXPECT_GT(shares_error_in_float(scene, t, d, wide, 2e-5), error);
  EXPECT_GT(shares_error_in_float(scene, t, d, thin, 1e-5), error);
  const double of_pieces = shares_error_in_float(scene, t, d, none, 1e-5);
  EXPECT_GT(of_pieces, error) << "without area: that of the pieces near the pixel";
  EXPECT_TRUE(std::isfinite(of_pieces));
  EXPECT_EQ(shares_error_in_float(in_double, t, d, wide, 1e-5), 0);
  t.outline.clear();
  EXPECT_EQ(shares_error_in_float(scene, t, d, none, 1e-5), 0) << "not bounded";
}

TEST(ClipError, RoundingTakesOffAPiecesAltitude) {
  const Projected scene = project(floor_across_the_eye());
  const Triangle& t = scene.triangles[0];
  const PixelSite site(scene, t, 60, 10);
  const double rounding = t.reach - scene.snap, thinnest = thinnest_piece(t.outline, glm::dvec2(site.d), 2 * t.reach);
  EXPECT_GT(rounding, 0.001);
  EXPECT_NEAR(site.pieces.framed, thinnest - 2 * rounding, 1e-9 * thinnest);
}

// x added up over 60 rows or less, at columns up to 80.
TEST(ClipError, SteppedEdgesMoveAlongX) {
  Conventions stepped, in_float;
  stepped.subpixel_bits = in_float.subpixel_bits = Conventions::kFloat;
  stepped.depth_arithmetic = Conventions::DepthArithmetic::in_float_stepped;
  in_float.depth_arithmetic = Conventions::DepthArithmetic::in_float;
  const Projected by_steps = project(floor_across_the_eye(), stepped), none = project(floor_across_the_eye(), in_float);
  const Triangle &t = by_steps.triangles[0], &same = none.triangles[0];
  EXPECT_EQ(same.stepped, glm::dvec2(0));
  EXPECT_GT(t.stepped.x, 20 * 80 * kFloatRounding);
  EXPECT_LE(t.stepped.x, 2 * 63 * 80 * kFloatRounding);
  EXPECT_EQ(t.stepped.y, 0);
  EXPECT_GT(t.reach, same.reach);
  // Edge functions begin at the box of all that is before the near plane, which is far larger than the frame.
  stepped.depth_arithmetic = Conventions::DepthArithmetic::in_float_stepped_edges;
  const Triangle by_edges = project(floor_across_the_eye(), stepped).triangles[0];
  EXPECT_GT(by_edges.stepped.x, 140 * 100 * kFloatRounding);
  EXPECT_EQ(by_edges.stepped.y, by_edges.stepped.x);
}

// A side beside the pixel (30, 20)'s centre, 0.0005 pixel to its right.
TEST(ClipError, SteppedEdgesLeavePixelsBesideThemOpen) {
  Scene scene = floor_across_the_eye();
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, 80, 0, 60, 0, 1};
  Mesh& mesh = scene.meshes[0];
  mesh.positions = {{30.5f + 0.0005f, 1, -0.5f}, {70, 30, -0.5f}, {30.5f + 0.0005f, 59, -0.5f}, {0, 0, -0.5f}};
  mesh.triangles = {{0, 1, 2}};
  Request request;
  request.legal = true;
  request.conventions.subpixel_bits = Conventions::kFloat;
  request.conventions.depth_arithmetic = Conventions::DepthArithmetic::in_float;
  EXPECT_EQ(legal_by_boxes(scene, request).at(30, 20).size(), 1u);
  request.conventions.depth_arithmetic = Conventions::DepthArithmetic::in_float_stepped;
  EXPECT_EQ(legal_by_boxes(scene, request).at(30, 20).size(), 2u);
  EXPECT_EQ(legal_by_boxes(scene, request).at(31, 20).size(), 1u);
}

// A band of 100 x 10 pixels, one of whose corners is cut off by 0.01 pixel: the thin pieces lie along a diagonal and at
// the cut.
TEST(Pieces, CountWhereTheyComeNearThePoint) {
  const std::vector<glm::dvec2> band = {{0, 0}, {100, 0}, {100, 9.99}, {99.99, 10}, {0, 10}};
  EXPECT_LT(widths(band).pieces, 0.02);
  EXPECT_NEAR(thinnest_piece(band, {50, 8}, 0), 9.9, 0.2) << "far from the diagonal of the thin pieces";
  EXPECT_LT(thinnest_piece(band, {50, 5}, 0.01), 0.02) << "on it";
  EXPECT_LT(thinnest_piece(band, {50, 8}, 4), 0.02) << "within the margin";
  EXPECT_TRUE(std::isinf(thinnest_piece(band, {50, 20}, 1))) << "outside";
  EXPECT_TRUE(std::isinf(thinnest_piece({}, {0, 0}, 1)));
}

TEST(Pieces, ATrianglesDistanceIsThatOfItsBorderUnlessInside) {
  const std::array<glm::dvec2, 3> left = {{{0, 0}, {4, 0}, {0, 3}}}, right = {{{0, 0}, {0, 3}, {4, 0}}},
                                  line = {{{0, 0}, {2, 0}, {4, 0}}}, spot = {{{1, 1}, {1, 1}, {1, 1}}};
  for (const auto& t : {left, right}) {
    EXPECT_EQ(distance_to_triangle({1, 1}, t), 0);
    EXPECT_EQ(distance_to_triangle({0, 0}, t), 0);
    EXPECT_EQ(distance_to_triangle({-3, -4}, t), 5);
    EXPECT_EQ(distance_to_triangle({2, -1}, t), 1);
    EXPECT_NEAR(distance_to_triangle({4, 3}, t), 2.4, 1e-12);
  }
  EXPECT_EQ(distance_to_triangle({6, 0}, line), 2) << "in line, and beyond";
  EXPECT_EQ(distance_to_triangle({3, 0}, line), 0);
  EXPECT_EQ(distance_to_triangle({1, 2}, spot), 1);
}

}  // namespace
}  // namespace plumbline::math

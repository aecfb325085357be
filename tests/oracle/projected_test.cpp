// Triangles projected in double, and bounds at their pixels: cuts, distances, errors of vectors and of pieces.
#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/arithmetic/error_in_float.h"
#include "reference/arithmetic/texture.h"
#include "reference/oracle/candidates.h"
#include "reference/oracle/oracle.h"
#include "reference/oracle/pixel_site.h"
#include "tests/oracle/window_answers.h"

namespace plumbline::math {
namespace {

using C = Conventions;

constexpr Frustum kFrustum{-1, 1, -1, 1, 1, 10};

// A triangle in eye space, by a perspective projection.
Scene seen_from_the_eye(const std::array<glm::vec3, 3>& positions) {
  Scene scene = window_scene({positions});
  scene.projection = kFrustum;
  scene.meshes[0].positions.assign(positions.begin(), positions.end());
  return scene;
}

// No far plane cuts under depth clamp, however far the triangle, whose z_clip has errors as large as its distance.
TEST(Projected, FarTrianglesAreNotCutUnderDepthClamp) {
  for (const float far : {1.0f, 1e4f, 1e5f, 1e6f}) {
    Scene scene = seen_from_the_eye(
        {glm::vec3(-0.4f, -0.4f, -1) * far, glm::vec3(0.4f, -0.4f, -1) * far, glm::vec3(0.4f, 0.4f, -1) * far});
    scene.depth_clamp = true;
    EXPECT_FALSE(project(scene).triangles[0].cut) << far;
    scene.meshes[0].positions[1].x *= 4;
    EXPECT_TRUE(project(scene).triangles[0].cut) << far << ", beyond the right side";
    scene.meshes[0].positions[1] = glm::vec3(0.4f, -0.4f, 1) * far;
    EXPECT_TRUE(project(scene).triangles[0].cut) << far << ", behind the eye";
  }
}

// GzRender's w is 1 at its view plane, at distance 1 / tan(fov / 2) before the eye.
TEST(Projected, ClipWIsADistanceByTheProjection) {
  Scene scene = seen_from_the_eye({glm::vec3(-1, -1, -3), glm::vec3(1, -1, -3), glm::vec3(0, 1, -3)});
  EXPECT_EQ(project(scene).distance_per_w, 1);
  scene.dialect = Dialect::gzrender;
  scene.projection = ViewPlane{120};
  const Projected by_plane = project(scene);
  EXPECT_NEAR(by_plane.distance_per_w, 1 / std::sqrt(3.0), 1e-12);
  EXPECT_NEAR(by_plane.distance_per_w * by_plane.corners[0].v.z, std::abs(by_plane.corners[0].z_eye), 1e-9);
  EXPECT_EQ(project(window_scene({{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}})).distance_per_w, 0);
}

// A corner 1e-6 before the far plane, which float may find beyond it: a piece may be a sliver along the diagonal.
TEST(Projected, FloatMayCutOffACornerBesideAPlane) {
  const auto with_corner_at = [](float z) {
    return window_scene({{glm::vec3(2.5f, 2.5f, z), glm::vec3(30.5f, 2.5f, 0.5f), glm::vec3(30.5f, 30.5f, 0.5f)}});
  };
  C in_float;
  in_float.subpixel_bits = C::kFloat;
  const auto altitude_at = [](const Projected& projected, int x, int y) {
    return PixelSite(projected, projected.triangles[0], x, y).pieces.framed;
  };
  const Projected beside = project(with_corner_at(0.999999f), in_float);
  ASSERT_EQ(beside.triangles[0].may_be_cut_off.size(), 1u);
  EXPECT_EQ(beside.triangles[0].may_be_cut_off[0].at, glm::dvec2(-13.5));
  EXPECT_LT(beside.triangles[0].may_be_cut_off[0].reach, 0.001);
  EXPECT_EQ(altitude_at(beside, 10, 10), 0) << "on the diagonal";
  EXPECT_GT(altitude_at(beside, 11, 10), 1);
  for (const float z : {0.5f, 0.999f, 1.0f, 1.001f}) {
    const Projected apart = project(with_corner_at(z), in_float);
    EXPECT_TRUE(apart.triangles[0].may_be_cut_off.empty()) << z;
    EXPECT_GT(altitude_at(apart, 10, 10), 0) << z;
  }
  EXPECT_TRUE(project(with_corner_at(0.999999f)).triangles[0].may_be_cut_off.empty()) << "snapped";
}

// A triangle across the plane of the eye, sampled off the centre: the centre may lie outside of all pieces.
TEST(Projected, PiecesNearASampleHaveErrors) {
  Scene scene = seen_from_the_eye({glm::vec3(-0.3f, -0.2f, -2), glm::vec3(0.35f, -0.2f, -2), glm::vec3(0.1f, 4, 3)});
  scene.depth_clamp = true;
  C in_float;
  in_float.depth_arithmetic = C::DepthArithmetic::in_float;
  scene.frame.pass.sample = 0;
  const Projected projected = project(scene, in_float);
  const Triangle& t = projected.triangles[0];
  ASSERT_TRUE(t.cut && !t.ahead);
  int in_reach = 0;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const PixelSite site(projected, t, x, y);
      if (!site.inside) continue;
      ++in_reach;
      EXPECT_GT(shares_error_in_float(projected, t, projected.to_centre(site.d), site.pieces, 0.1), 0) << x << "," << y;
    }
  }
  EXPECT_GT(in_reach, 40);
}

// Normals that grow along (1, 1, 1): a corner displaced by a step of the grid moves each component by the bound, and
// the vector by sqrt(3) of it. The light shines along the change.
TEST(OracleBounds, OfFragmentsLightHoldForNormalsBetweenSnappedCorners) {
  Scene scene = window_scene({{glm::vec3(2, 2, 0.5f), glm::vec3(30, 2, 0.5f), glm::vec3(2, 30, 0.5f)}});
  scene.meshes[0].colors.clear();
  const glm::vec3 across = glm::normalize(glm::vec3(1, -1, 0)), along = glm::normalize(glm::vec3(1, 1, 1));
  scene.meshes[0].normals = {across, across + 0.5f * along, across};
  Draw& draw = scene.draws[0];
  draw.lit = true, draw.shading = Shading::phong;
  Light light;
  light.kind = Light::Kind::directional, light.vector = along;
  light.ambient = light.specular = glm::vec3(0), light.diffuse = glm::vec3(1);
  scene.lights = {light};
  scene.light_model.ambient = glm::vec3(0);
  C snapped;
  snapped.attribute_corners = C::Corners::snapped, snapped.subpixel_bits = 2;
  snapped.open = {"subpixel_rounding"};  // else corners on the grid stay where they are
  const auto answer_of = [&](const Scene& of) { return legal(of, snapped).at(10, 10).front(); };
  const LegalAnswer middle = answer_of(scene);
  Scene moved = scene;  // as a grid of 1/4 pixel moves corners: by up to 1/8
  for (glm::vec3& p : moved.meshes[0].positions) p.x += 0.125f;
  const double off = std::abs(answer_of(moved).color.r - middle.color.r);
  EXPECT_GT(off, 1e-3);
  EXPECT_LE(off, middle.color_bound);
}

// A thin triangle whose grid covers the pixel: its centre may lie outside in double, whoever computes the colour.
TEST(OracleBounds, OfColorsAreTheSameNowAndOnDemand) {
  Scene scene = window_scene({{glm::vec3(2.25f, 16.5015f, 0.5f), {30.25f, 16.5015f, 0.5f}, {16, 16.515f, 0.5f}}});
  for (std::size_t i = 0; i < 3; ++i) scene.meshes[0].colors[i] = glm::vec4(glm::vec3(i == 2 ? 1 : 0), 1);
  C inclusive;
  inclusive.tie_rule = C::TieRule::inclusive;
  const Projected projected = project(scene, inclusive);
  std::array<float, 2> bound{};
  for (const bool now : {true, false}) {
    Candidates candidates(1'000'000);
    add_by_boxes(projected, candidates);
    add_by_edges(projected, candidates);
    Request request;
    request.records = {};
    if (now) request.pixels = {{16, 16}};
    const Legal answers = consult(scene, projected, candidates, request).legal;
    ASSERT_EQ(answers.certain(16, 16), 1u);
    bound[now ? 1 : 0] = answers.at(16, 16).front().color_bound;
  }
  EXPECT_EQ(bound[0], bound[1]);
}

// Squares of a frame of odd height, whose rows are counted from the top, begin at its highest row.
TEST(SquaresOfPixels, BeginAtTheFirstRow) {
  using enum C::Rows;
  for (const int height : {48, 49}) {
    for (int y = 0; y < height; ++y) {
      const int from_top = height - 1 - y;
      EXPECT_EQ(lower_row_of_square(from_bottom, height, y), y - y % 2);
      EXPECT_EQ(lower_row_of_square(C::Rows::from_top, height, y), height - 1 - (from_top - from_top % 2 + 1)) << y;
    }
  }
}

}  // namespace
}  // namespace plumbline::math

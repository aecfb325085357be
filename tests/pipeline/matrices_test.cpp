// Stage 0. Expected numbers are worked out by hand from the definitions of gluLookAt, gluPerspective, glOrtho,
// glRotate.
#include "pipeline/geometry.h"

#include <cmath>

#include <gtest/gtest.h>

namespace plumbline::pipeline {
namespace {

/// Where the transforms put a point of the model, seen by a camera at the origin that looks down -z.
glm::vec4 placed(const std::vector<Transform>& transforms, glm::vec3 p_model) {
  Scene scene;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  Draw draw;
  draw.transforms = transforms;
  return matrices(scene, draw).model_view * glm::vec4(p_model, 1);
}

TEST(PipelineMatrices, TheLastTransformActsFirst) {
  EXPECT_EQ(placed({Translate{{1, 2, 3}}, Scale{{2, 4, 8}}}, {1, 1, 1}), glm::vec4(3, 6, 11, 1));
  EXPECT_EQ(placed({Scale{{2, 4, 8}}, Translate{{1, 2, 3}}}, {1, 1, 1}), glm::vec4(4, 12, 32, 1));
}

TEST(PipelineMatrices, RotationIsCounterClockwiseInDegrees) {
  EXPECT_EQ(placed({Rotate{90, {1, 0, 0}}}, {0, 1, 0}), glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(placed({Rotate{90, {0, 3, 0}}}, {0, 0, 1}), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(placed({Rotate{90, {0, 0, 0.5}}}, {1, 0, 0}), glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(placed({Rotate{-90, {0, 0, 1}}}, {1, 0, 0}), glm::vec4(0, -1, 0, 1));
}

TEST(PipelineMatrices, AThirdOfATurnAboutTheDiagonalPermutesTheAxes) {
  const glm::vec4 p = placed({Rotate{120, {2, 2, 2}}}, {1, 2, 3});
  EXPECT_NEAR(p.x, 3, 1e-6);
  EXPECT_NEAR(p.y, 1, 1e-6);
  EXPECT_NEAR(p.z, 2, 1e-6);
}

TEST(PipelineMatrices, AnyRotationKeepsItsAxisAndLengths) {
  const glm::vec3 axis = glm::normalize(glm::vec3(1, -2, 0.7f));
  for (double degrees : {-211.0, 17.0, 133.0}) {
    const std::vector<Transform> turn{Rotate{degrees, {2, -4, 1.4}}};
    const glm::vec3 kept(placed(turn, axis));
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(kept[i], axis[i], 2e-7);
    const glm::vec3 side = glm::normalize(glm::cross(axis, glm::vec3(0, 0, 1)));
    const glm::vec3 turned(placed(turn, side));
    EXPECT_NEAR(glm::dot(turned, side), std::cos(degrees * M_PI / 180), 4e-7);
    EXPECT_NEAR(glm::dot(turned, glm::cross(axis, side)), std::sin(degrees * M_PI / 180), 4e-7);
  }
}

TEST(PipelineMatrices, NormalsGoByTheInverseTranspose) {
  Scene scene;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  Draw draw;
  draw.transforms = {Translate{{5, 6, 7}}, Rotate{90, {0, 0, 1}}, Scale{{2, 4, 0.5}}};
  const Mat3<float> n = matrices(scene, draw).normal;
  // Scaled by 1/2, 1/4, 2, then turned: x to y, y to -x.
  EXPECT_EQ(n * Vec3<float>(1, 0, 0), Vec3<float>(0, 0.5f, 0));
  EXPECT_EQ(n * Vec3<float>(0, 1, 0), Vec3<float>(-0.25f, 0, 0));
  EXPECT_EQ(n * Vec3<float>(0, 0, 1), Vec3<float>(0, 0, 2));
  // A plane's normal stays one under a shear (a turn between two scales): not so by the matrix itself.
  draw.transforms = {Scale{{1, 3, 1}}, Rotate{30, {0, 0, 1}}, Scale{{2, 1, 1}}};
  const Matrices<float> m = matrices(scene, draw);
  const glm::vec3 in_plane(1, 1, 0), normal(1, -1, 0);
  EXPECT_NEAR(glm::dot(m.normal * normal, glm::vec3(m.model_view * glm::vec4(in_plane, 0))), 0, 1e-6);
}

TEST(PipelineMatrices, LightsAreTakenToEyeSpace) {
  Scene scene;
  scene.camera = {{5, 0, 0}, {0, 0, 0}, {0, 1, 0}};  // looks down -x: world z is eye space's -x, world x its z
  EXPECT_EQ(light_sources(scene).size(), 0u);
  Light lamp;
  lamp.kind = Light::Kind::point;
  lamp.vector = {1, 2, 3};
  lamp.spot = Spot{{0, -2, 1}, 30, 0};
  Light sun;
  sun.vector = {4, 2, 0};
  scene.lights = {sun, lamp};
  const auto lights = light_sources(scene);
  ASSERT_EQ(lights.size(), 2u);
  EXPECT_EQ(lights[0].p_eye, Vec4<float>(0, 2, 4, 0));
  EXPECT_EQ(lights[0].spot_eye, Vec3<float>(0));
  EXPECT_EQ(lights[1].p_eye, Vec4<float>(-3, 2, -4, 1));
  EXPECT_EQ(lights[1].spot_eye, Vec3<float>(-1, -2, 0));
}

TEST(PipelineMatrices, TheViewActsAfterTheModel) {
  Scene scene;
  scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
  Draw draw;
  draw.transforms = {Rotate{90, {0, 1, 0}}};
  EXPECT_EQ(matrices(scene, draw).model_view * glm::vec4(0, 0, 0, 1), glm::vec4(0, 0, -5, 1));
}

TEST(PipelineMatrices, TheAspectIsTheFrames) {
  Scene scene;
  scene.frame.width = 300;
  scene.frame.height = 200;
  scene.projection = Perspective{90, 1, 2};
  const Mat4<float> p = matrices(scene, {}).projection;
  EXPECT_FLOAT_EQ(p[0][0], 2.0f / 3.0f);
  EXPECT_FLOAT_EQ(p[1][1], 1);
}

TEST(PipelineMatrices, WindowIsHalfTheFrame) {
  Scene scene;
  scene.frame.width = 5;
  scene.frame.height = 2;
  const Matrices<float> m = matrices(scene, {});
  EXPECT_EQ(m.win_scale, Vec3<float>(2.5f, 1, 0.5f));
  EXPECT_EQ(m.win_translate, Vec3<float>(2.5f, 1, 0.5f));

  Draw draw;
  // (f - n) / 2 and (n + f) / 2 (OpenGL 2.1, section 2.11.1), whichever is larger.
  draw.depth_range = {0.75f, 0.25f};
  EXPECT_EQ(matrices(scene, draw).win_scale, Vec3<float>(2.5f, 1, -0.25f));
  EXPECT_EQ(matrices(scene, draw).win_translate, Vec3<float>(2.5f, 1, 0.5f));
  draw.depth_range = {1, 1};
  EXPECT_EQ(matrices(scene, draw).win_scale.z, 0);
  EXPECT_EQ(matrices(scene, draw).win_translate.z, 1);
}

TEST(PipelineMatrices, DustBelow1e12IsSweptAndNothingAbove) {
  const glm::vec4 p = placed({Translate{{9.9e-13, 1.01e-12, 0}}}, {0, 0, 0});
  EXPECT_EQ(p.x, 0);
  EXPECT_EQ(p.y, 1.01e-12f);
  const glm::vec4 q = placed({Translate{{-9.9e-13, -1.01e-12, 0}}}, {0, 0, 0});
  EXPECT_EQ(q.x, 0);
  EXPECT_EQ(q.y, -1.01e-12f);
}

TEST(PipelineMatrices, RoundedOnceFromDouble) {
  // Ten tenths are 1 when added up in double and rounded once, 1.0000001 when added up in float.
  const std::vector<Transform> tenths(10, Translate{{0.1, 0, 0}});
  EXPECT_EQ(placed(tenths, {0, 0, 0}).x, 1.0f);
  float in_float = 0;
  for (int i = 0; i < 10; ++i) in_float += 0.1f;
  ASSERT_NE(in_float, 1.0f) << "the test has lost its point";
}

}  // namespace
}  // namespace plumbline::pipeline

#include <gtest/gtest.h>

#include <cmath>

#include "reference/arithmetic/matrices.h"
#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

// Rows as one writes them; GLM stores columns.
glm::dmat4 rows(std::array<double, 16> m) {
  return glm::transpose(
      glm::dmat4(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11], m[12], m[13], m[14], m[15]));
}

template <class M>
void expect_near(const M& is, const M& expected, double bound) {
  for (int c = 0; c < M::length(); ++c)
    for (int r = 0; r < M::col_type::length(); ++r)
      EXPECT_NEAR(is[c][r], expected[c][r], bound) << "row " << r << ", column " << c;
}

Scene scene_with(std::vector<Transform> transforms) {
  Scene scene = scene_of(200, 100);
  scene.camera = {.eye = {0, 0, 0}, .center = {0, 0, -1}, .up = {0, 1, 0}};  // the identity
  scene.draws[0].transforms = std::move(transforms);
  return scene;
}

glm::dmat4 model_view(const Scene& scene) { return math::double_matrices(scene, scene.draws[0]).model_view; }

TEST(Matrices, LookAtFromTheSide) {
  Scene scene = scene_with({});
  scene.camera = {.eye = {5, 0, 0}, .center = {0, 0, 0}, .up = {0, 2, 0}};
  // From +x, world -z lies to the right, and the origin 5 ahead.
  expect_near(math::view_matrix(scene), rows({0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, -5, 0, 0, 0, 1}), 1e-15);
}

TEST(Matrices, PerspectiveIsGluPerspective) {
  Scene scene = scene_with({});
  scene.projection = Perspective{90, 1, 3};
  // f = cot 45 = 1, over the aspect of 2; (near + far) / (near - far) = -2; 2 near far / (near - far) = -3.
  expect_near(math::double_matrices(scene, scene.draws[0]).projection,
              rows({0.5, 0, 0, 0, 0, 1, 0, 0, 0, 0, -2, -3, 0, 0, -1, 0}), 1e-15);
}

TEST(Matrices, OrthographicIsGlOrtho) {
  Scene scene = scene_with({});
  scene.projection = Orthographic{-1, 3, 2, 6, 1, 5};
  expect_near(math::double_matrices(scene, scene.draws[0]).projection,
              rows({0.5, 0, 0, -0.5, 0, 0.5, 0, -2, 0, 0, -0.5, -1.5, 0, 0, 0, 1}), 1e-15);
}

TEST(Matrices, FrustumIsGlFrustum) {
  Scene scene = scene_with({});
  scene.projection = Frustum{-1, 3, 2, 6, 1, 3};
  // 2 near / (right - left) = 1/2; (right + left) / (right - left) = 1/2; (top + bottom) / (top - bottom) = 2.
  expect_near(math::double_matrices(scene, scene.draws[0]).projection,
              rows({0.5, 0, 0.5, 0, 0, 0.5, 2, 0, 0, 0, -2, -3, 0, 0, -1, 0}), 1e-15);
}

TEST(Matrices, TransformsActLastFirst) {
  // Scaled, then turned from +x to +y, then moved.
  const Scene scene = scene_with({Translate{{10, 0, 0}}, Rotate{90, {0, 0, 5}}, Scale{{2, 3, 4}}});
  expect_near(model_view(scene), rows({0, -3, 0, 10, 2, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1}), 1e-15);
}

TEST(Matrices, RotationIsCounterClockwiseAboutEachAxis) {
  const double h = std::sqrt(0.5);
  expect_near(model_view(scene_with({Rotate{45, {1, 0, 0}}})), rows({1, 0, 0, 0, 0, h, -h, 0, 0, h, h, 0, 0, 0, 0, 1}),
              1e-15);
  expect_near(model_view(scene_with({Rotate{45, {0, 1, 0}}})), rows({h, 0, h, 0, 0, 1, 0, 0, -h, 0, h, 0, 0, 0, 0, 1}),
              1e-15);
}

TEST(Matrices, NormalsGoByTheInverseTranspose) {
  const Scene scene = scene_with({Scale{{2, 4, 1}}});
  expect_near(math::double_matrices(scene, scene.draws[0]).normal, glm::dmat3(0.5, 0, 0, 0, 0.25, 0, 0, 0, 1), 1e-15);
}

TEST(Matrices, WindowIsHalfTheFrame) {
  const Scene scene = scene_with({});
  const Matrices<double> m = math::float_matrices(scene, scene.draws[0]);
  EXPECT_EQ(m.win_scale, glm::dvec3(100, 50, 0.5));
  EXPECT_EQ(m.win_translate, glm::dvec3(100, 50, 0.5));
}

TEST(Matrices, FloatMatricesAreRoundedOnceAndFreeOfDust) {
  const Scene scene = scene_with({Translate{{0.1, 0, 0}}, Rotate{90, {0, 0, 1}}});
  const Matrices<double> exact = math::double_matrices(scene, scene.draws[0]);
  const Matrices<double> rounded = math::float_matrices(scene, scene.draws[0]);
  EXPECT_NE(exact.model_view[0][0], 0.0) << "cos 90 degrees is dust in double: else this test shows nothing";
  EXPECT_EQ(rounded.model_view[0][0], 0.0);
  EXPECT_EQ(exact.model_view[3][0], 0.1);
  EXPECT_EQ(rounded.model_view[3][0], static_cast<double>(0.1f));
  EXPECT_EQ(rounded.normal[0][0], 0.0);
  EXPECT_EQ(rounded.projection[1][1], static_cast<double>(static_cast<float>(exact.projection[1][1])));
}

TEST(ExactMatrices, OnePerDraw) {
  Scene scene = scene_with({Translate{{1, 2, 3}}});
  scene.draws.push_back(scene.draws[0]);
  scene.draws[1].transforms = {Translate{{4, 5, 6}}};
  const auto matrices = run(scene, Stage::matrices, {}).records.matrices;
  ASSERT_EQ(matrices.size(), 2u);
  EXPECT_EQ(glm::dvec3(matrices[0].model_view[3]), glm::dvec3(1, 2, 3));
  EXPECT_EQ(glm::dvec3(matrices[1].model_view[3]), glm::dvec3(4, 5, 6));
}

TEST(ExactVertices, GoThroughTheMatricesGiven) {
  Scene scene = scene_of(4, 4, 0);
  scene.meshes[0].positions = {{1, 2, 3}, {-1, 0, 0.5}};
  scene.meshes[0].normals = {{1, 0, 0}, {0, 0, -1}};
  Records<double> in;
  in.matrices.resize(1);
  in.matrices[0].model_view = rows({0, -1, 0, 10, 1, 0, 0, 0, 0, 0, 1, -5, 0, 0, 0, 1});
  in.matrices[0].projection = rows({2, 0, 0, 0, 0, 3, 0, 0, 0, 0, -2, -3, 0, 0, -1, 0});
  in.matrices[0].normal = glm::dmat3(3, 4, 0, 0, 1, 0, 0, 0, 7);
  const auto v = run(scene, Stage::vertex, in).records.vertices;
  ASSERT_EQ(v.size(), 2u);
  EXPECT_EQ(v[0].p_eye, glm::dvec4(8, 1, -2, 1));
  EXPECT_EQ(v[0].p_clip, glm::dvec4(16, 3, 1, 2));
  EXPECT_NEAR(glm::distance(v[0].n_eye, glm::dvec3(0.6, 0.8, 0)), 0, 1e-15);
  EXPECT_EQ(v[1].p_eye, glm::dvec4(10, -1, -4.5, 1));
  EXPECT_NEAR(glm::distance(v[1].n_eye, glm::dvec3(0, 0, -1)), 0, 1e-15);
}

TEST(ExactVertices, RefusesRecordsThatDoNotFit) {
  Scene scene = scene_of(4, 4, 0);
  EXPECT_THROW(run(scene, Stage::vertex, {}), std::invalid_argument);
  Records<double> in;
  in.matrices.resize(1);
  scene.meshes[0].positions = {{0, 0, 0}};
  EXPECT_THROW(run(scene, Stage::vertex, in), std::invalid_argument) << "a position without a normal";
}

}  // namespace
}  // namespace plumbline

#include <gtest/gtest.h>

#include <cmath>

#include "reference/arithmetic/light.h"
#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

// One draw under one white light without an ambient colour. Eye space is the world; the material is 0 until set.
struct Lamp : testing::Test {
  Lamp() {
    scene.camera = {.eye = {0, 0, 0}, .center = {0, 0, -1}, .up = {0, 1, 0}};
    scene.lights.resize(1);
    Material& m = scene.draws[0].material;
    m.ambient = m.diffuse = m.specular = m.emission = glm::vec4(0);
  }
  Material& material() { return scene.draws[0].material; }
  glm::dvec4 color(glm::dvec3 n_eye, glm::dvec3 p_eye = {0, 0, -5}) {
    Records<double> in;
    in.vertices = {{glm::dvec4(p_eye, 1), {}, n_eye}};
    scene.meshes[0].positions.resize(1);
    return run(scene, Stage::light, in).records.lit.at(0).color;
  }
  Scene scene = scene_of(4, 4);
};

void expect_near(glm::dvec4 is, glm::dvec4 expected) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(is[i], expected[i], 1e-12) << "channel " << i;
}

TEST_F(Lamp, DiffuseIsTheCosine) {
  material().diffuse = {0.5f, 0.25f, 1, 0.75f};
  scene.lights[0].vector = {0, 0, 9};  // any length
  expect_near(color({0.6, 0, 0.8}), {0.4, 0.2, 0.8, 0.75});
  expect_near(color({0.6, 0, -0.8}), {0, 0, 0, 0.75});
}

TEST_F(Lamp, EmissionAndAmbientTermsAdd) {
  material().emission = {0.125f, 0, 0, 0};
  material().ambient = {0.5f, 0.5f, 0.25f, 0};
  scene.light_model.ambient = {0.25f, 0.5f, 1};
  scene.lights[0].ambient = {0.5f, 0, 0.5f};
  scene.lights[0].diffuse = glm::vec3(0);
  scene.lights.push_back(scene.lights[0]);
  // The light is behind; its ambient term stays.
  expect_near(color({0, 0, -1}), {0.125 + 0.125 + 2 * 0.25, 0.25, 0.25 + 2 * 0.125, 0});
}

TEST_F(Lamp, SpecularByTheHalfVectorOfAnInfiniteViewer) {
  material().specular = {1, 0.5f, 0, 0};
  material().shininess = 2;
  scene.lights[0].vector = {1, 0, 0};
  // h is (1, 0, 1) / sqrt 2 wherever the point lies; n.h = 1.4 / sqrt 2, squared .98.
  expect_near(color({0.6, 0, 0.8}, {3, 4, -5}), {0.98, 0.49, 0, 0});
  // n.h > 0 but the light is behind the surface: f is 0.
  expect_near(color({-0.6, 0, 0.8}), {0, 0, 0, 0});
}

// 1000^128 is beyond double; OpenGL leaves overflow open (2.1, 2.1.1).
TEST_F(Lamp, APowerBeyondDoubleLeavesTheOtherTerms) {
  material().diffuse = {0, 0.5f, 0, 1};
  material().specular = {0.5f, 0, 0, 0};
  material().shininess = 128;
  scene.lights[0].diffuse = {0, 0x1p-9f, 0};
  expect_near(color({0, 0, 1000}), {1, 1000.0 / 1024, 0, 1});
}

TEST_F(Lamp, ZeroToTheZeroIsOne) {
  material().specular = {0.5f, 0, 0, 0};
  material().shininess = 0;
  scene.lights[0].vector = {1, 0, -0.1};
  const glm::dvec3 n = glm::normalize(glm::dvec3(1, 0, -3));  // n.VP > 0, n.h < 0
  ASSERT_LT(glm::dot(n, glm::normalize(scene.lights[0].vector) + glm::dvec3(0, 0, 1)), 0);
  expect_near(color(n), {0.5, 0, 0, 0});
  material().shininess = 2;  // n.h is clamped before it is squared
  expect_near(color(n), {0, 0, 0, 0});
}

TEST_F(Lamp, PointLightShinesFromItsPlaceInTheWorld) {
  material().diffuse = {1, 1, 1, 1};
  scene.lights[0].kind = Light::Kind::point;
  scene.lights[0].vector = {3, 0, -1};
  // From (0,0,-5) to (3,0,-1): (.6, 0, .8).
  expect_near(color({0, 0, 1}), {0.8, 0.8, 0.8, 1});
  scene.camera = {.eye = {0, 0, 7}, .center = {0, 0, 0}, .up = {0, 1, 0}};
  // Its eye position is (3, 0, -8) now: from (0,0,-12), the same.
  expect_near(color({0, 0, 1}, {0, 0, -12}), {0.8, 0.8, 0.8, 1});
  // A light at the point itself has no direction: it lights nothing, and breaks nothing.
  expect_near(color({0, 0, 1}, {3, 0, -8}), {0, 0, 0, 1});
}

TEST_F(Lamp, DirectionTurnsWithTheCameraButDoesNotMove) {
  material().diffuse = {1, 1, 1, 1};
  scene.lights[0].vector = {1, 0, 0};
  scene.camera = {.eye = {50, 0, 0}, .center = {0, 0, 0}, .up = {0, 1, 0}};  // world +x is eye +z
  expect_near(color({0, 0.6, 0.8}), {0.8, 0.8, 0.8, 1});
}

TEST_F(Lamp, ResultIsClamped) {
  material().emission = {2, -1, 0.5f, 0};
  material().diffuse = {0, 0, 0, 3};
  expect_near(color({0, 0, 1}), {1, 0, 0.5, 1});
}

TEST_F(Lamp, UnlitTakesTheMeshColourOrTheMaterial) {
  scene.draws[0].lit = false;
  material().diffuse = {0.25f, 0.5f, 2, 1};
  expect_near(color({0, 0, 1}), {0.25, 0.5, 1, 1});
  scene.meshes[0].colors = {{0.5f, -1, 3, 0.5f}};
  expect_near(color({0, 0, 1}), {0.5, 0, 1, 0.5});
}

TEST_F(Lamp, EachDrawHasItsOwnMaterialAndVertices) {
  scene.meshes[0].positions.resize(2);
  scene.draws.push_back(scene.draws[0]);
  scene.draws[0].material.emission = {0.25f, 0, 0, 0};
  scene.draws[1].material.emission = {0, 0.5f, 0, 0};
  Records<double> in;
  in.vertices.resize(4, {{0, 0, -5, 1}, {}, {0, 0, 1}});
  scene.draws[1].material.diffuse = {0, 0, 1, 0};
  in.vertices[2].n_eye = {0.6, 0, 0.8};
  const auto lit = run(scene, Stage::light, in).records.lit;
  ASSERT_EQ(lit.size(), 4u);
  expect_near(lit[1].color, {0.25, 0, 0, 0});
  expect_near(lit[2].color, {0, 0.5, 0.8, 0});
  expect_near(lit[3].color, {0, 0.5, 1, 0});
  in.vertices.pop_back();
  EXPECT_THROW(run(scene, Stage::light, in), std::invalid_argument);
}

// 1000^128 is beyond double, let alone float.
TEST_F(Lamp, APowerBeyondDoubleLeavesTermsOfZeroAtZero) {
  material().specular = {1e-30f, 0, 0, 1};
  material().shininess = 128;
  scene.lights[0].vector = {0, 0, 1};
  expect_near(color({0, 0, 1000}), {1, 0, 0, 0});
  expect_near(color({0, 0, 1}), {1e-30, 0, 0, 0});
}

}  // namespace
}  // namespace plumbline

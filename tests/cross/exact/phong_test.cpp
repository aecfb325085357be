// Exact's stage 9 where light is per fragment, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

// One fragment of a lit draw under one white light along +z.
glm::dvec4 shaded(const Scene& scene, glm::dvec4 color, glm::dvec3 n, glm::dvec3 p) {
  Records<double> in;
  in.triangles = {window_triangle({glm::dvec3(0, 0, 0), {4, 0, 0}, {0, 4, 0}})};
  in.covered = {{0, 1, 1}};
  in.attributes = {{color}};
  in.varyings[Varying::normal].fragments = {glm::dvec4(n, 0)};
  in.varyings[Varying::position].fragments = {glm::dvec4(p, 1)};
  return run(scene, Stage::shade, in).records.shaded.at(0).color;
}

Scene phong() {
  Scene scene = scene_of(4, 4);
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.lights.resize(1);
  Draw& draw = scene.draws[0];
  const glm::vec4 black(0, 0, 0, 1);
  draw.material = {black, {0.5f, 0.25f, 0, 0.75f}, black, black, 0};
  draw.shading = Shading::phong;
  return scene;
}

void expect_color(glm::dvec4 is, glm::dvec4 expected) {
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(is[i], expected[i], 1e-12) << "channel " << i;
}

TEST(ExactPhong, TheNormalIsBroughtToUnitLength) {
  expect_color(shaded(phong(), {9, 9, 9, 9}, {0.3, 0, 0.4}, {0, 0, -1}), {0.4, 0.2, 0, 0.75});
}

TEST(ExactPhong, LocalViewerAndDistanceGoByTheFragmentsPosition) {
  Scene scene = phong();
  scene.light_model.local_viewer = true;
  scene.draws[0].material.diffuse = {0, 0, 0, 1};
  scene.draws[0].material.specular = {0.5f, 0, 0, 1};
  scene.draws[0].material.shininess = 2;
  // E is (-.6, 0, .8), H (-1, 0, 3) / sqrt 10.
  expect_color(shaded(scene, {}, {0, 0, 7}, {3, 0, -4}), {0.45, 0, 0, 1});
}

TEST(ExactPhong, ColoursStandForTheMaterialWhereTheMeshHasSome) {
  Scene scene = phong();
  scene.draws[0].color_material = ColorMaterial::diffuse;
  expect_color(shaded(scene, {1, 0.5, 0, 0.25}, {0, 0, 1}, {0, 0, -1}), {0.5, 0.25, 0, 0.75});
  scene.meshes[0].colors = {{0, 0, 0, 0}};
  expect_color(shaded(scene, {1, 0.5, 0, 0.25}, {0, 0, 1}, {0, 0, -1}), {1, 0.5, 0, 0.25});
}

}  // namespace
}  // namespace plumbline

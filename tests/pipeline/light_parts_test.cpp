// What light hands on beside the front's colour: the back's, and the specular part kept apart (OpenGL 2.1 spec 2.14.1).
#include <gtest/gtest.h>

#include "kernels/shade.h"
#include "pipeline/geometry.h"
#include "pipeline/render.h"

namespace plumbline::pipeline {
namespace {

/// A square that fills a frame of floats and faces away from the eye, its normals with it; a white light from +z, and a
/// grey one without a specular colour from -z.
Scene backs() {
  Scene scene;
  scene.frame.width = scene.frame.height = 4;
  scene.frame.color = ColorFormat::rgba32f;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{-1, 1, -1, 1, 0, 10};
  Mesh mesh;
  mesh.positions = {{-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}};
  mesh.normals.assign(4, {0, 0, -1});
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  scene.meshes = {mesh};
  scene.lights.resize(2);
  scene.lights[1].vector = {0, 0, -1};
  scene.lights[1].diffuse = {0.5f, 0.5f, 0.5f};
  scene.lights[1].specular = glm::vec3(0);
  const glm::vec4 black(0, 0, 0, 1);
  Draw draw;
  draw.material = {black, {0.5f, 0, 0, 0.75f}, black, black, 0};
  draw.back_material = Material{black, {0, 0.5f, 0, 0.25f}, {0, 0, 0.25f, 1}, black, 0};
  scene.draws = {draw};
  return scene;
}

std::vector<Vec4<float>> carried_of(const Scene& scene, Varying v) {
  const std::vector<Vertex<float>> vertices(4, {{0, 0, -2, 1}, {}, {0, 0, -1}});
  std::vector<Attributes> attributes;
  light({scene, scene.draws[0], scene.meshes[0], light_sources(scene), vertices}, attributes);
  std::vector<Vec4<float>> out;
  for (const Attributes& a : attributes) out.push_back(a[v]);
  return out;
}

TEST(PipelineLightParts, OneSideHasNoBack) {
  const Scene scene = backs();
  EXPECT_EQ(carried(scene), std::vector<Varying>{});
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), glm::vec4(0.25f, 0, 0, 0.75f))
      << "the front's material, lit from beyond";
}

TEST(PipelineLightParts, BackFacesHaveTheBacksMaterialAndNormal) {
  Scene scene = backs();
  scene.light_model.sides = LightModel::Sides::two;
  EXPECT_EQ(carried(scene), std::vector<Varying>{Varying::back_color});
  EXPECT_EQ(carried_of(scene, Varying::back_color).at(3), Vec4<float>(0, 0.5f, 0.25f, 0.25f));
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), glm::vec4(0, 0.5f, 0.25f, 0.25f));
  for (glm::uvec3& t : scene.meshes[0].triangles) std::swap(t.x, t.y);  // now it faces the eye, its normals do not
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), glm::vec4(0.25f, 0, 0, 0.75f));
}

TEST(PipelineLightParts, WithoutAMaterialOfItsOwnTheBackHasTheFronts) {
  Scene scene = backs();
  scene.light_model.sides = LightModel::Sides::two;
  scene.draws[0].back_material.reset();
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), glm::vec4(0.5f, 0, 0, 0.75f));
}

TEST(PipelineLightParts, TheSpecularPartIsKeptApartAndAdded) {
  Scene scene = backs();
  scene.light_model.sides = LightModel::Sides::two;
  scene.light_model.separate_specular = true;
  EXPECT_EQ(carried(scene).size(), 3u);
  EXPECT_EQ(carried_of(scene, Varying::back_color).at(0), Vec4<float>(0, 0.5f, 0, 0.25f));
  EXPECT_EQ(carried_of(scene, Varying::back_secondary).at(0), Vec4<float>(0, 0, 0.25f, 0)) << "without alpha";
  EXPECT_EQ(carried_of(scene, Varying::secondary).at(0), Vec4<float>(0, 0, 0, 0)) << "the front has none";
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), glm::vec4(0, 0.5f, 0.25f, 0.25f));
  // Each part is clamped, and so is the sum.
  scene.lights[0].diffuse = glm::vec3(9);
  scene.draws[0].back_material->specular = {0, 0.5f, 0.25f, 1};
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), glm::vec4(0, 1, 0.25f, 0.25f));
}

TEST(PipelineLightParts, PerFragmentToo) {
  Scene scene = backs();
  scene.light_model.sides = LightModel::Sides::two;
  const glm::vec4 per_vertex = render(scene).color_rgba32f(1, 1);
  scene.draws[0].shading = Shading::phong;
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), per_vertex);
  scene.light_model.separate_specular = true;
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), per_vertex);
  scene.light_model.sides = LightModel::Sides::one;
  EXPECT_EQ(render(scene).color_rgba32f(1, 1), glm::vec4(0.25f, 0, 0, 0.75f));
}

TEST(PipelineLightParts, ColourSumClampsColoursAndLeavesAlpha) {
  const Color<float> sum = color_sum<float>({0.75f, 0.5f, 0, 0.5f}, {0.5f, 0.25f, 0.125f, 1});
  EXPECT_EQ(sum.r, 1);
  EXPECT_EQ(sum.g, 0.75f);
  EXPECT_EQ(sum.b, 0.125f);
  EXPECT_EQ(sum.a, 0.5f);
}

}  // namespace
}  // namespace plumbline::pipeline

// Light per fragment: at the interpolated normal, brought back to unit length, and position.
#include <gtest/gtest.h>

#include <cmath>

#include "kernels/shade.h"
#include "pipeline/render.h"

namespace plumbline::pipeline {
namespace {

/// A square that fills a frame of floats, eye space its model space, its normals leaning 53 degrees to either side; one
/// white light from +z.
Scene leaning() {
  Scene scene;
  scene.frame.width = scene.frame.height = 5;
  scene.frame.color = ColorFormat::rgba32f;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{-1, 1, -1, 1, 0, 10};
  Mesh mesh;
  mesh.positions = {{-1, -1, -2}, {1, -1, -2}, {1, 1, -2}, {-1, 1, -2}};
  mesh.normals = {{-0.8f, 0, 0.6f}, {0.8f, 0, 0.6f}, {0.8f, 0, 0.6f}, {-0.8f, 0, 0.6f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {mesh};
  scene.lights = {Light{}};
  Draw draw;
  const glm::vec4 black(0, 0, 0, 1);
  draw.material = {black, {0.5f, 0.25f, 0, 0.75f}, black, black, 0};
  draw.shading = Shading::phong;
  scene.draws = {draw};
  return scene;
}
double x_of(int pixel) { return (pixel + 0.5) / 2.5 - 1; }

TEST(PipelinePhong, LightsTheInterpolatedNormal) {
  const Frame frame = render(leaning());
  for (int x = 0; x < 5; ++x) {
    const double cosine = 0.6 / std::hypot(0.8 * x_of(x), 0.6);
    EXPECT_NEAR(frame.color_rgba32f(x, 2).r, 0.5 * cosine, 1e-6) << x;
    EXPECT_NEAR(frame.color_rgba32f(x, 2).g, 0.25 * cosine, 1e-6) << x;
    EXPECT_EQ(frame.color_rgba32f(x, 2).a, 0.75f);
  }
  Scene gouraud = leaning();
  gouraud.draws[0].shading = Shading::gouraud;
  EXPECT_NEAR(render(gouraud).color_rgba32f(2, 2).r, 0.3, 1e-6) << "the corners' light, in the middle too";
}

TEST(PipelinePhong, LightsTheInterpolatedPosition) {
  Scene scene = leaning();
  scene.meshes[0].normals.assign(4, {0, 0, 1});
  scene.lights[0].kind = Light::Kind::point;
  scene.lights[0].vector = {0, 0, -1};  // 1 before the middle
  scene.lights[0].attenuation = {0, 0, 1};
  const Frame frame = render(scene);
  for (int x = 0; x < 5; ++x) {
    const double square = x_of(x) * x_of(x) + 1;  // the distance's; N.L is one over its root
    EXPECT_NEAR(frame.color_rgba32f(x, 2).r, 0.5 / (square * std::sqrt(square)), 1e-6) << x;
  }
}

TEST(PipelinePhong, NormalsAreOfUnitLengthWhateverTheyWereAtTheCorners) {
  Scene scene = leaning();
  const Frame frame = render(scene);
  scene.draws[0].transforms = {Scale{{1, 1, 1}}};
  for (glm::vec3& n : scene.meshes[0].normals) n *= 0.25f;
  scene.draws[0].normals = Normals::as_they_are;
  const Frame shorter = render(scene);
  for (int x = 0; x < 5; ++x) EXPECT_EQ(shorter.color_rgba32f(x, 2), frame.color_rgba32f(x, 2)) << "powers of two";
}

TEST(PipelinePhong, VertexColoursAreTheMaterialThere) {
  Scene scene = leaning();
  scene.meshes[0].normals.assign(4, {0, 0, 1});
  scene.meshes[0].colors = {{0, 0, 0, 0}, {1, 0, 0, 1}, {1, 0, 0, 1}, {0, 0, 0, 0}};
  scene.draws[0].color_material = ColorMaterial::diffuse;
  const Frame frame = render(scene);
  for (int x = 0; x < 5; ++x) {
    EXPECT_NEAR(frame.color_rgba32f(x, 2).r, (x_of(x) + 1) / 2, 1e-6) << x;
    EXPECT_NEAR(frame.color_rgba32f(x, 2).a, (x_of(x) + 1) / 2, 1e-6) << "as its alpha is";
  }
  scene.draws[0].color_material = ColorMaterial::none;
  EXPECT_NEAR(render(scene).color_rgba32f(1, 2).r, 0.5, 1e-6) << "the material's own";
}

TEST(PipelinePhong, VerticesAreNotLit) {
  const Scene scene = leaning();
  Capture capture;
  const Request request{{Stage::light}, false, {}, {}};
  Recorder records(scene, request, 0, capture);
  render(scene, production_stages(), records);
  for (const Lit<double>& v : capture.records.lit) EXPECT_EQ(glm::vec4(v.color), scene.draws[0].material.diffuse);
  EXPECT_EQ(Vec4<float>(capture.records.varyings[Varying::normal].vertices.at(1)), Vec4<float>(0.8f, 0, 0.6f, 0));
  EXPECT_EQ(capture.records.varyings[Varying::position].vertices.at(1), Vec4<double>(1, -1, -2, 1));
}

TEST(PipelinePhong, UnlitDrawsAreAsWithGouraud) {
  Scene scene = leaning();
  scene.draws[0].lit = false;
  const auto phong = render(scene).color_rgba32f.values();
  scene.draws[0].shading = Shading::gouraud;
  EXPECT_EQ(render(scene).color_rgba32f.values(), phong);
}

}  // namespace
}  // namespace plumbline::pipeline

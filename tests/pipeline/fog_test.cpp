// Fog: the specification's three equations (2.1, section 3.10), and the way of its distance to the fragments.
#include "kernels/shade.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/render.h"

namespace plumbline::pipeline {
namespace {

Fog fog_of(Fog::Mode mode, float density, float start = 0, float end = 1) {
  return {mode, glm::vec3(0.25f, 0.5f, 1), density, start, end};
}

TEST(PipelineFog, FactorsAreTheSpecifications) {
  const auto near = [](double f, double expected) { EXPECT_NEAR(f, expected, 1.0 / (1 << 24)) << expected; };
  for (const float c : {0.0f, 0.125f, 1.0f, 2.5f, 30.0f, 1000.0f}) {
    near(fog_factor<float>(fog_of(Fog::Mode::exp, 0.5f), -c), std::exp(-0.5 * c));
    near(fog_factor<float>(fog_of(Fog::Mode::exp2, 0.5f), -c), std::exp(-0.25 * c * c));
    near(fog_factor<float>(fog_of(Fog::Mode::exp, 0), -c), 1);
  }
  const Fog linear = fog_of(Fog::Mode::linear, 1, 2, 10);
  for (const auto& [c, f] :
       {std::pair(0.0f, 1.0), {2.0f, 1.0}, {4.0f, 0.75}, {9.0f, 0.125}, {10.0f, 0.0}, {11.0f, 0.0}}) {
    EXPECT_EQ(fog_factor<float>(linear, -c), f) << c;
    EXPECT_EQ(fog_factor<float>(linear, c), f) << "the distance, whichever side";
  }
  const Fog backwards = fog_of(Fog::Mode::linear, 1, 10, 2);
  EXPECT_EQ(fog_factor<float>(backwards, -4), 0.25f);
}

TEST(PipelineFog, LongBeyondAllFloatsIsFogAlone) {
  EXPECT_EQ(fog_factor<float>(fog_of(Fog::Mode::exp, 1e6f), -1e6f), 0);
  EXPECT_EQ(fog_factor<float>(fog_of(Fog::Mode::exp2, 1e6f), -1e6f), 0);
}

TEST(PipelineFog, MixesColoursAndLeavesAlpha) {
  const Fog fog = fog_of(Fog::Mode::linear, 1, 0, 4);
  const Color<float> c = fogged<float>(fog, {1, 0, 0.5f, 0.75f}, -3);
  EXPECT_EQ(c.r, 0.25f * 1 + 0.75f * 0.25f);
  EXPECT_EQ(c.g, 0.75f * 0.5f);
  EXPECT_EQ(c.b, 0.25f * 0.5f + 0.75f * 1);
  EXPECT_EQ(c.a, 0.75f);
}

Scene triangle_in_fog(Shading shading) {
  Scene scene;
  scene.frame.width = scene.frame.height = 16;
  scene.frame.color = ColorFormat::rgba32f;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Perspective{60, 1, 100};
  Mesh mesh;
  mesh.positions = {{-2, -2, -2}, {2, -2, -2}, {0, 30, -40}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.triangles = {{0, 1, 2}};
  scene.meshes = {mesh};
  Draw draw;
  draw.lit = false;
  draw.shading = shading;
  draw.fog = fog_of(Fog::Mode::linear, 1, 0, 50);
  scene.draws = {draw};
  return scene;
}

TEST(PipelineFog, IsOfTheFragmentsOwnDistanceEvenWhereColoursAreFlat) {
  for (const Shading shading : {Shading::gouraud, Shading::flat}) {
    const Scene scene = triangle_in_fog(shading);
    Capture capture;
    const Request request{{Stage::light, Stage::clip, Stage::window}, false, {}, {}};
    Recorder recorder(scene, request, 0, capture);
    render(scene, production_stages(), recorder);
    const Records<double>& records = capture.records;
    const auto& columns = records.varyings[Varying::position];
    ASSERT_EQ(columns.vertices.size(), 3u);
    ASSERT_EQ(columns.clipped.size(), records.polygons.vertices.size());
    ASSERT_EQ(columns.triangles.size(), records.triangles.size());
    EXPECT_EQ(columns.vertices[2], Vec4<double>(0, 30, -40, 1));
    for (std::size_t i = 0; i < columns.clipped.size(); ++i) {  // w_clip is -z_eye
      EXPECT_NEAR(columns.clipped[i].z, -records.polygons.vertices[i].p_clip.w, 1e-5);
    }
    const Frame frame = render(scene);
    // A triangle of one colour: at the distance d, y = -2 + k (d - 2), which the ray y = slope d meets.
    const double k = 32.0 / 38;
    for (int y = 2; y < 12; ++y) {
      const double slope = (y + 0.5 - 8) / 8 * std::tan(3.14159265358979 / 6);
      const double distance = (2 + 2 * k) / (k - slope);
      const double f = (50 - distance) / 50;
      const glm::vec4 c = frame.color_rgba32f(7, y);
      ASSERT_NE(c, scene.frame.clear_color) << y;
      EXPECT_NEAR(c.r, f * 0.8f + (1 - f) * 0.25, 1e-6) << y;
      EXPECT_EQ(c.a, 1);
    }
  }
}

TEST(PipelineFog, DrawsWithoutItAreTheSameBesideIt) {
  Scene scene = triangle_in_fog(Shading::gouraud);
  Scene plain = scene;
  plain.draws[0].fog.reset();
  scene.draws.insert(scene.draws.begin(), plain.draws[0]);
  scene.draws[1].scissor = Scissor{0, 0, 0, 0};
  EXPECT_EQ(render(scene).color_rgba32f.values(), render(plain).color_rgba32f.values());
}

}  // namespace
}  // namespace plumbline::pipeline

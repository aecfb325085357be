// Stage 2 by hand: light_cases.h.
#include <gtest/gtest.h>

#include "pipeline/geometry.h"
#include "tests/pipeline/light_cases.h"

namespace plumbline::pipeline {
namespace {

glm::vec4 lit(const Scene& scene, const test::LightCase& of) {
  const Vertex<float> vertex{Vec4<float>(of.p_eye, 1), {}, of.n_eye};
  std::vector<Attributes> out;
  light({scene, scene.draws[0], scene.meshes[0], light_sources(scene), std::span(&vertex, 1)}, out);
  return out.at(0).color();
}

TEST(PipelineLightCases, ByHand) {
  for (const test::LightCase& of : test::light_cases()) {
    const glm::vec4 color = lit(test::scene_of(of), of);
    EXPECT_NEAR(color.r, of.red, 1e-6) << of.name;
    EXPECT_EQ(color.a, static_cast<float>(of.alpha)) << of.name;
  }
}

TEST(PipelineLightCases, ColoursOfAMeshWithoutAnyAreTheMaterials) {
  test::LightCase of = test::light_cases().front();
  of.change = [](Light&, LightModel&, Draw& d) {
    d.color_material = ColorMaterial::diffuse;
    d.material.diffuse = {0.5f, 0, 0, 0.75f};
  };
  Scene scene = test::scene_of(of);
  scene.meshes[0].colors.clear();
  EXPECT_EQ(lit(scene, of), glm::vec4(0.5f, 0, 0, 0.75f));
}

TEST(PipelineLightCases, ALampAtTheVertexWithNothingButItsDistanceToDivideByIsANumber) {
  test::LightCase of = test::light_cases().front();
  of.change = [](Light& l, LightModel& m, Draw& d) {
    l.kind = Light::Kind::point;
    l.vector = {0, 0, -5};
    l.attenuation = {0, 0, 1};
    l.ambient = {1, 0, 1};
    l.spot = Spot{{0, 0, -1}, 90, 0};
    m.local_viewer = true;
    d.material.ambient = d.material.diffuse = d.material.specular = glm::vec4(1);
  };
  for (const bool cone : {true, false}) {
    Scene scene = test::scene_of(of);
    if (!cone) scene.lights[0].spot.reset();
    const glm::vec4 color = lit(scene, of);
    for (int c = 0; c < 4; ++c) EXPECT_TRUE(color[c] >= 0 && color[c] <= 1) << color[c];
  }
}

}  // namespace
}  // namespace plumbline::pipeline

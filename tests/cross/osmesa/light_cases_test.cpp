// OpenGL's own light, and the light program that stands in where it has none, by hand: light_cases.h.
#include "tests/pipeline/light_cases.h"

#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "reference/osmesa/scene/light_program.h"

namespace plumbline {
namespace {

TEST(OsmesaLightCases, ByHand) {
  const auto osmesa = make_opengl();
  int programs = 0;
  for (const test::LightCase& of : test::light_cases()) {
    const Scene scene = test::scene_of(of);
    programs += osmesa::needs_light_program(scene, scene.draws[0]);
    const Request request{{Stage::vertex, Stage::light}, false, {}, {}};
    const Records<double> records = osmesa->capture(scene, request).records;
    EXPECT_EQ(records.vertices.at(0).n_eye, glm::dvec3(glm::vec3(of.n_eye))) << of.name;
    EXPECT_NEAR(records.lit.at(0).color.r, of.red, 2.5e-5) << of.name;
    EXPECT_NEAR(records.lit.at(0).color.a, of.alpha, 1e-6) << of.name;
  }
  EXPECT_GT(programs, 5);
}

// Shininess 0 under a light that fades: the specular term is 1 where N.L > 0.
TEST(OsmesaLightCases, MesasSpecularTermOfNoShininess) {
  test::LightCase of{"", {}, {0, 0, -5}, {0.6, 0, 0.8}, 0.25};
  of.change = [](Light& l, LightModel&, Draw& d) {
    l.kind = Light::Kind::point;
    l.vector = {0, 0, -3};
    l.attenuation = {2, 0, 0};
    d.material.specular.r = 0.5f;
  };
  const Scene scene = test::scene_of(of);
  EXPECT_TRUE(osmesa::needs_light_program(scene, scene.draws[0]));
  const Request request{{Stage::light}, false, {}, {}};
  EXPECT_NEAR(make_opengl()->capture(scene, request).records.lit.at(0).color.r, of.red, 1e-6);
}

// Shininess 0 of the front alone, N.L > 0 and N.H < 0: the specular term is 0^0 = 1, as it is where the back has 0 too.
TEST(OsmesaLightCases, MesasSpecularTermOfNoShininessOnOneSide) {
  for (const float back : {0.0f, 20.0f}) {
    test::LightCase of{"", {}, {0, 0, -5}, {0.6, 0, -0.8}, 0.5};
    of.change = [back](Light& l, LightModel& model, Draw& d) {
      l.kind = Light::Kind::directional;
      l.vector = {1, 0, 0};
      model.sides = LightModel::Sides::two;
      d.material.diffuse.r = 0;
      d.material.specular.r = 0.5f;
      d.back_material = d.material;
      d.back_material->shininess = back;
    };
    const Scene scene = test::scene_of(of);
    EXPECT_EQ(osmesa::needs_light_program(scene, scene.draws[0]), back > 0);
    const Request request{{Stage::light}, false, {}, {}};
    EXPECT_NEAR(make_opengl()->capture(scene, request).records.lit.at(0).color.r, of.red, 1e-6) << back;
  }
}

TEST(OsmesaLightCases, TheProgramIsNotNeededWhereTheFixedFunctionHasTheLight) {
  Scene scene = test::scene_of(test::light_cases()[8]);  // a local viewer
  EXPECT_FALSE(osmesa::needs_light_program(scene, scene.draws[0]));
  scene.light_model.specular = LightModel::Specular::reflection;
  EXPECT_TRUE(osmesa::needs_light_program(scene, scene.draws[0]));
  scene.draws[0].lit = false;
  EXPECT_FALSE(osmesa::needs_light_program(scene, scene.draws[0]));
}

}  // namespace
}  // namespace plumbline

// The bound of a lit colour's rounding: each of its terms, on scenes where that term alone counts.
#include "reference/arithmetic/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "reference/arithmetic/color_error.h"
#include "tests/check/fixtures.h"

namespace plumbline::math {
namespace {

struct LightBoundsTest : testing::Test {
  LightBoundsTest() {
    scene.camera = {{0, 0, 5}, {0, 0, 0}, {0, 1, 0}};
    draw.material.ambient = {0.5, 0.5, 0.5, 1};
    draw.material.diffuse = {0.5, 1, 0, 1};
    draw.material.specular = {0.25, 0.5, 1, 1};
    draw.material.shininess = 10;
    light.vector = {0, 0, 2};
    light.ambient = {1, 2, 3};
    light.diffuse = {4, 2, 1};
    light.specular = {2, 2, 0.5};
  }
  DoubleMaterial material() const {
    const Material& m = draw.material;
    return {m.ambient, m.diffuse, m.specular, m.emission, m.shininess};
  }
  LightBounds at(glm::dvec3 p_eye, glm::dvec3 n_eye) const {
    return light_bounds(scene, material(), {glm::dvec4(p_eye, 1), glm::dvec4(0), n_eye});
  }
  glm::dvec3 magnitude_at(glm::dvec3 p_eye) const { return at(p_eye, {0, 0, 1}).magnitude; }
  Scene scene;
  Draw draw;
  Light light;
};

TEST_F(LightBoundsTest, IsAtLeastTheClampedResult) { EXPECT_EQ(magnitude_at({0, 0, 0}), glm::dvec3(1)); }

TEST_F(LightBoundsTest, SumsEmissionSceneAndLights) {
  draw.material.emission = {2, 0, 3, 1};
  scene.light_model.ambient = {1, 1, 4};
  EXPECT_EQ(magnitude_at({0, 0, 0}), glm::dvec3(2.5, 1, 5));
  scene.lights = {light};
  // A power's slope is taken at the far end of its argument's error. Along z the half vector's length is 2: the
  // highlight counts 1 + 10 (1 + 1/2) times.
  const glm::dvec3 one(0.5 + 2 + 16 * 0.5, 1 + 2 + 16 * 1, 1.5 + 0 + 16 * 0.5);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(magnitude_at({0, 0, 0})[c], glm::dvec3(2.5, 0.5, 5)[c] + one[c], 1e-3);
  }
  scene.lights = {light, light};
  EXPECT_NEAR(magnitude_at({7, 8, 9}).r, 2.5 + 2 * one.r, 1e-3) << "wherever the vertex is";
}

TEST_F(LightBoundsTest, OfAPointLightGrowsNearIt) {
  light.kind = Light::Kind::point;
  light.vector = {0, 0, 3};  // eye space: (0, 0, -2)
  scene.lights = {light};
  // From (0, 0, -6): (2 + 6) / 4 + 1 = 3 times.
  EXPECT_NEAR(magnitude_at({0, 0, -6}).r, 0.5 + 3 * 2 + 3 * 16 * 0.5, 1e-3);
  EXPECT_GT(magnitude_at({0, 0, -2.01}).r, 100 * magnitude_at({0, 0, -6}).r / 3);
}

TEST_F(LightBoundsTest, OfALightAtTheVertexAreInfinite) {
  light.kind = Light::Kind::point;
  light.vector = {0, 0, 3};
  scene.lights = {light};
  EXPECT_EQ(magnitude_at({0, 0, -2}).r, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isfinite(magnitude_at({0, 0, -2.0001}).r));
}

TEST_F(LightBoundsTest, OverflowIsOfSpecularTermsOfZeroAlone) {
  draw.material.specular = {0.25, 0, 1, 1};
  draw.material.shininess = 128;
  scene.lights = {light};
  EXPECT_EQ(at({0, 0, 0}, {0, 0, 1}).overflows, glm::bvec3(false));
  EXPECT_EQ(at({0, 0, 0}, {0, 0, 1.9}).overflows, glm::bvec3(false)) << "1.9^128 = 2^118.5";
  EXPECT_EQ(at({0, 0, 0}, {0, 0, 2}).overflows, glm::bvec3(false, true, false));
  scene.lights.push_back(light);
  scene.lights[1].kind = Light::Kind::point;
  scene.lights[1].vector = {0, 0, 8};
  scene.lights[1].spot = Spot{{0, 0, 1}, 10, 0};  // away from the vertex
  EXPECT_EQ(at({0, 0, 0}, {0, 0, 2}).overflows, glm::bvec3(true)) << "a cone's 0 times the power";
}

TEST_F(LightBoundsTest, TheHighlightMayComeOrGoWhereTheLightGrazes) {
  light.vector = {1, 0, 0};
  scene.lights = {light};
  // N.H = 1 / sqrt 2, to the 10th: 1/32 of the term.
  EXPECT_NEAR(at({0, 0, 0}, {0, 0, 1}).jump.r, 2 * 0.25 / 32, 1e-12);
  EXPECT_NEAR(at({0, 0, 0}, {0, 0, 1}).jump.b, 0.5 * 1 / 32.0, 1e-12);
  const auto tilted = [&](double sine) { return at({0, 0, 0}, {sine, 0, std::sqrt(1 - sine * sine)}).jump.r; };
  constexpr double kU = kFloatRounding;
  EXPECT_GT(tilted(15 * kU), 0);
  EXPECT_GT(tilted(-15 * kU), 0);
  EXPECT_EQ(tilted(17 * kU), 0);
  EXPECT_EQ(tilted(-17 * kU), 0);
}

TEST_F(LightBoundsTest, AConesEndTakesItsLightAlong) {
  light.kind = Light::Kind::point;
  light.vector = {0, 0, 4};  // eye space: (0, 0, -1)
  light.spot = Spot{{0, 0, -1}, 45, 2};
  scene.lights = {light};
  draw.material.specular = glm::vec4(0);
  // On the edge: cos 45 of the normal, half of the cone, and the ambient term with it.
  EXPECT_NEAR(at({1, 0, -2}, {0, 0, 1}).jump.r, 0.5 * (0.5 + 2 * std::sqrt(0.5)), 1e-3);
  EXPECT_EQ(at({1.001, 0, -2}, {0, 0, 1}).jump.r, 0);
  EXPECT_EQ(at({0.999, 0, -2}, {0, 0, 1}).jump.r, 0);
  EXPECT_EQ(at({1.001, 0, -2}, {0, 0, 1}).magnitude.r, 1) << "nothing is left of the light";
  // Within, on the axis: the cone's slope, 2, for k + 1 = (1 + 2) / 1 + 2.
  EXPECT_NEAR(at({0, 0, -2}, {0, 0, 1}).magnitude.r, (0.5 + 4 * 2) + 2 * 5 * (0.5 + 2), 1e-3);
}

TEST_F(LightBoundsTest, DistanceCountsTwice) {
  light.kind = Light::Kind::point;
  light.vector = {0, 0, 3};
  light.attenuation = {0, 1, 0};
  scene.lights = {light};
  draw.material.specular = glm::vec4(0);
  // A quarter, from (0, 0, -6), where k = 3, and 2 k of what is there.
  EXPECT_NEAR(magnitude_at({0, 0, -6}).r, 0.25 * (0.5 + 3 * 2) + 0.25 * 6 * (0.5 + 2), 1e-3);
}

TEST_F(LightBoundsTest, GzRendersRuleTurnsAtTheHorizon) {
  scene.light_model.sides = LightModel::Sides::flip;
  light.vector = {1, 0, 0};
  scene.lights = {light};
  draw.material.specular = glm::vec4(0);
  EXPECT_NEAR(at({0, 0, 0}, {1, 0, 0}).jump.r, 2, 1e-9) << "all but the ambient term";
  EXPECT_NEAR(at({0, 0, 0}, {-1, 0, 0}).jump.r, 2, 1e-9) << "turned over, it is lit as well";
  EXPECT_EQ(at({0, 0, 0}, glm::normalize(glm::dvec3(1, 0, 1e-5))).jump.r, 0);
}

TEST_F(LightBoundsTest, LongNormalsSteepenThePower) {
  light.specular = {0.2, 2, 0.5};
  scene.lights = {light};
  draw.material.diffuse = glm::vec4(0);
  draw.material.shininess = 2;
  // N.H = 2: (N.H)^2 = 4, its slope 2 * 2, of an argument twice as long (1 + 1/2 times).
  EXPECT_NEAR(at({0, 0, 0}, {0, 0, 2}).magnitude.r, 0.5 + 0.05 * (4 + 4 * 3), 1e-6);
}

// A highlight of 1 or more is clamped to 1 however large its power is.
TEST_F(LightBoundsTest, OfAHighlightBeyondOneAreThoseOfOne) {
  light.specular = {2, 2, 0};
  scene.lights = {light};
  draw.material.diffuse = {0, 0, 1, 1};
  draw.material.shininess = 128;
  const LightBounds certain = at({0, 0, 0}, {0, 0, 1000});
  EXPECT_EQ(glm::dvec2(certain.magnitude), glm::dvec2(1));
  EXPECT_LT(certain.magnitude.b, 1e4) << "0 of the power";
  EXPECT_EQ(certain.overflows, glm::bvec3(false, false, true));
  draw.material.specular = {0.0625, 0, 0, 1};
  draw.material.shininess = 2;  // 2 / 16 (N.H)^2
  EXPECT_GT(at({0, 0, 0}, {0, 0, 2.75}).magnitude.r, 1) << "N.H^2 = 7.6";
  EXPECT_EQ(at({0, 0, 0}, {0, 0, 2.875}).magnitude.r, 1) << "N.H^2 = 8.3";
  EXPECT_GT(
      light_bounds(scene, material(), {glm::dvec4(0, 0, 0, 1), glm::dvec4(0), glm::dvec3(0, 0, 2.875)}, {0, 0.25, 0})
          .magnitude.r,
      1)
      << "N is off by 1/4";
}

TEST_F(LightBoundsTest, InheritWhatTheInputsAreOffBy) {
  const auto inherited = [&](const LightInputs& errors) {
    return light_bounds(scene, material(), {glm::dvec4(0, 0, -6, 1), glm::dvec4(0), glm::dvec3(0, 0.6, 0.8)}, errors)
        .inherited.r;
  };
  draw.material.specular = glm::vec4(0);
  light.kind = Light::Kind::point;
  light.vector = {0, 0, 3};  // eye space: (0, 0, -2), 4 away
  light.attenuation = {0, 1, 0};
  scene.lights = {light};
  EXPECT_EQ(inherited({}), 0);
  EXPECT_NEAR(inherited({0, 0.01, 0}), 0.25 * 2 * 0.01, 1e-9) << "the normal, by the diffuse term's 2, a quarter of it";
  // The position: 2 of it over the distance in N.L, and 1 / (d - e) for 1 / d of all.
  const double moved = 1 / 3.99 - 0.25;
  EXPECT_NEAR(inherited({0.01, 0, 0}), (0.25 + moved) * 2 * 0.005 + moved * (0.5 + 0.8 * 2), 1e-9);
  // Colours: the emission and no scene's ambient light, and of the lamp a quarter of its own.
  EXPECT_NEAR(inherited({0, 0, 0.01}), 0.01 * (1 + 0.25 * (1 + 0.8 * 4 + 2 * std::pow(0.8, 10))), 1e-9);
}

TEST_F(LightBoundsTest, OfAHighlightSeenAgainstTheLightGrows) {
  light.vector = {0, 0.1, -1};
  scene.lights = {light};
  // |L + z| is about 0.1: 1 + 10 (1 + 10).
  EXPECT_NEAR(magnitude_at({0, 0, 0}).r, 0.5 + 2 + 0.5 * (11 + 10 / 0.0997), 0.5);
}

// Of all vectors within an error of +z, those at which a line from the origin touches the sphere turn farthest.
TEST(UnitVector, BoundsTheDirectionOfEveryVectorWithinTheError) {
  const glm::dvec3 z(0, 0, 1);
  for (const double error : {0.01, 0.3, 0.4999}) {
    const double angle = std::asin(error), length = std::cos(angle);
    const glm::dvec3 farthest(length * std::sin(angle), 0, length * std::cos(angle));
    ASSERT_NEAR(glm::distance(z, farthest), error, 1e-15);
    const double off = glm::distance(z, glm::normalize(farthest));
    EXPECT_GE(unit({z, error}).error, off);
    EXPECT_NEAR(unit({z, error}).error, off, 1e-6);
  }
  EXPECT_EQ(unit({z, 0.5}).error, 2) << "no direction is certain";
}

// Position, normal and light off by their errors, at a cone's edge in half of the tries: colours stay within the bound.
TEST(LightError, HoldsWhateverItsInputsErrorsMake) {
  std::mt19937 random(9);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto direction = [&] {
    glm::dvec3 v(0);
    while (glm::length(v) > 1 || glm::length(v) < 0.01) v = {in(-1, 1), in(-1, 1), in(-1, 1)};
    return glm::normalize(v);
  };
  int finite = 0, reached = 0;  // a tenth of the bound or more
  for (int i = 0; i < 20'000; ++i) {
    Scene scene;
    scene.light_model.local_viewer = i % 2 == 0;
    scene.light_model.specular = i % 3 == 0 ? LightModel::Specular::reflection : LightModel::Specular::half_vector;
    scene.light_model.sides = i % 5 == 0 ? LightModel::Sides::flip : LightModel::Sides::one;
    Light& light = scene.lights.emplace_back();
    light.kind = i % 4 == 0 ? Light::Kind::directional : Light::Kind::point;
    light.ambient = glm::vec3(0.1f), light.diffuse = glm::vec3(0.6f), light.specular = glm::vec3(0.4f);
    if (i % 8 == 1) light.attenuation = glm::vec3(0.5f);
    const double off = std::exp2(in(-23, -8)), distance = in(0.3, 5);
    const glm::dvec3 to_light = direction(), p_eye(in(-2, 2), in(-2, 2), in(-8, -1)),
                     n_eye = glm::normalize(to_light + in(0, 1.5) * direction());
    std::vector<LightSource<double>> sources(1);
    sources[0].p_eye = light.kind == Light::Kind::point ? glm::dvec4(p_eye + distance * to_light, 1)
                                                        : glm::dvec4(distance * to_light, 0);
    if (i % 4 > 1) {
      light.spot = Spot{{}, static_cast<float>(in(5, 60)), i % 8 > 5 ? 0 : static_cast<float>(in(0, 128))};
      const glm::dvec3 across = glm::normalize(glm::cross(to_light, direction()));
      const double angle = glm::radians(static_cast<double>(light.spot->cutoff_degrees)) + in(-2, 2) * off / distance;
      sources[0].spot_eye = glm::normalize(-std::cos(angle) * to_light + std::sin(angle) * across);
    }
    const DoubleMaterial material{glm::dvec4(1), glm::dvec4(1), glm::dvec4(1), {0, 0, 0, 1}, in(0, 128)};
    const double light_off[] = {i % 3 == 1 ? off : 0};
    const double p_off = light.kind == Light::Kind::point || scene.light_model.local_viewer ? off : 0;
    const double bound =
        light_error(scene, material, {glm::dvec4(p_eye, 1), glm::dvec4(0), n_eye}, {p_off, off, 0, light_off}, sources);
    const glm::dvec4 middle = plumbline::math::light(scene, material, sources, p_eye, n_eye);
    finite += std::isfinite(bound);
    for (int k = 0; k < 4; ++k) {
      std::vector<LightSource<double>> moved = sources;
      moved[0].p_eye += glm::dvec4(light_off[0] * direction(), 0);
      const glm::dvec4 there =
          plumbline::math::light(scene, material, moved, p_eye + p_off * direction(), n_eye + off * direction());
      ASSERT_LE(std::abs(there.r - middle.r), bound) << i;
      reached += std::isfinite(bound) && std::abs(there.r - middle.r) >= bound / 10;
    }
  }
  EXPECT_GT(finite, 10'000);
  EXPECT_GT(reached, 1'000);
}

// Normals of length 4, which draws may leave as they are: highlights by the mirrored ray, seen from an eye that is off.
TEST(LightError, HoldsForLongNormals) {
  std::mt19937 random(9);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto direction = [&] {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  };
  constexpr double kLength = 4;
  Scene scene;
  scene.light_model.local_viewer = true;
  scene.light_model.specular = LightModel::Specular::reflection;
  Light& light = scene.lights.emplace_back();
  light.kind = Light::Kind::directional;
  light.ambient = light.diffuse = glm::vec3(0), light.specular = glm::vec3(0.4f);
  int bounded = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double off = std::exp2(in(-23, -8));
    const glm::dvec3 to_light = direction(), p_eye(in(-2, 2), in(-2, 2), in(-8, -1)),
                     n_eye = kLength * glm::normalize(to_light + in(0, 1.5) * direction());
    std::vector<LightSource<double>> sources(1);
    sources[0].p_eye = glm::dvec4(to_light, 0);
    const double specular = 0.5 / (kLength * kLength * kLength);
    const DoubleMaterial material{{0.1, 0.1, 0.1, 1}, {0, 0, 0, 1}, glm::dvec4(specular), glm::dvec4(0), in(0, 2)};
    const Vertex<double> vertex{glm::dvec4(p_eye, 1), glm::dvec4(0), n_eye};
    const double bound = light_error(scene, material, vertex, {off, 0, 0, {}}, sources);
    if (bound >= 1) continue;
    ++bounded;
    const double middle = plumbline::math::light(scene, material, sources, p_eye, n_eye).r;
    for (int k = 0; k < 8; ++k) {
      const double there = plumbline::math::light(scene, material, sources, p_eye + off * direction(), n_eye).r;
      ASSERT_LE(std::abs(there - middle), bound) << i;
    }
  }
  EXPECT_GT(bounded, 5'000);
}

// A direction is a direction, however long: its error is of its own length.
TEST_F(LightBoundsTest, ADirectionalLightsLengthSaysNothing) {
  scene.light_model.specular = LightModel::Specular::half_vector;
  const auto error = [&](double length) {
    const std::vector<LightSource<double>> sources = {{glm::dvec4(0, 0, length, 0), {}}};
    const double errors[] = {1e-7 * length};
    scene.lights = {light};
    return light_error(scene, material(), {{0, 0, -6, 1}, {}, glm::dvec3(0, 0.6, 0.8)}, {0, 0, 0, errors}, sources);
  };
  EXPECT_NEAR(error(1e-4) / error(1), 1, 1e-6);
  EXPECT_NEAR(error(1e4) / error(1), 1, 1e-6);
}

}  // namespace
}  // namespace plumbline::math

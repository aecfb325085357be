// Stage 2, and the transcendental functions under it (math.h) against long double.
#include "pipeline/geometry.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "kernels/math.h"

namespace plumbline::pipeline {
namespace {

long double relative_error(double is, long double expected) {
  return std::abs((static_cast<long double>(is) - expected) / expected);
}

TEST(PipelineMath, Log2OverItsWholeRange) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<std::uint64_t> normal(0x0010000000000000, 0x7fefffffffffffff);
  long double worst = 0;
  const auto check = [&](double x) {
    if (x == 1.0) return;  // below, exactly
    const long double error = relative_error(log2_of(x), std::log2(static_cast<long double>(x)));
    ASSERT_LT(error, 1e-12L) << x;
    worst = std::max(worst, error);
  };
  for (int i = 0; i < 20000; ++i) check(std::bit_cast<double>(normal(random)));
  // Near 1 the logarithm vanishes, at sqrt(2) the series is at its end.
  std::uniform_real_distribution<double> offset(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    check(1 + std::ldexp(offset(random), -(i % 50)) * 0.49);
    check(std::sqrt(2.0) * (1 + std::ldexp(offset(random), -(i % 50)) * 0.49));
  }
  for (double x : {std::numeric_limits<double>::min(), std::numeric_limits<double>::max()}) check(x);
  EXPECT_GT(worst, 0) << "nothing was compared";
  for (int e = -1022; e <= 1023; ++e) EXPECT_EQ(log2_of(std::ldexp(1.0, e)), e);
}

TEST(PipelineMath, Exp2OverItsWholeRange) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> whole(-1022, 1023), small(-1, 1);
  for (int i = 0; i < 40000; ++i) {
    for (double x :
         {whole(random), small(random), std::floor(whole(random)) + 0.5, std::ldexp(small(random), -i % 60)}) {
      if (x < -1022 || x > 1023) continue;
      ASSERT_LT(relative_error(exp2_of<double>(x), std::exp2(static_cast<long double>(x))), 1e-13L) << x;
    }
  }
  for (int e = -1022; e <= 1023; ++e) EXPECT_EQ(exp2_of<double>(e), std::ldexp(1.0, e));
  EXPECT_EQ(exp2_of<double>(std::nextafter(-1022.0, -2000.0)), 0);
  EXPECT_EQ(exp2_of<double>(-1e300), 0);
}

TEST(PipelineMath, PowerIsRightToTheLastPlaceOfAFloat) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> base(0, 1), exponent(0, 128), bits(-126, 0);
  // A float's own rounding, and the stated 1e-9; of a subnormal result, half its step.
  const long double step = std::ldexp(1.0L, -149), rounding = std::ldexp(1.0L, -24);
  for (int i = 0; i < 60000; ++i) {
    const float x = i % 3 == 0 ? std::exp2(bits(random)) : i % 3 == 1 ? base(random) : 1 - base(random) * 1e-3f;
    const float y = i % 2 == 0 ? exponent(random) : exponent(random) * 1e-3f;
    const long double expected = std::pow(static_cast<long double>(x), static_cast<long double>(y));
    const long double bound = std::max(expected * (rounding + 1e-9L), step * 0.5000001L);
    ASSERT_LE(std::abs(power<float>(x, y) - expected), bound) << x << " ^ " << y;
  }
}

TEST(PipelineMath, PowerAtTheCorners) {
  EXPECT_EQ(power<float>(0, 0), 1);
  EXPECT_EQ(power<float>(0.5f, 0), 1);
  EXPECT_EQ(power<float>(1, 0), 1);
  for (float y : {1e-45f, 1e-3f, 1.0f, 7.5f, 128.0f}) {
    EXPECT_EQ(power<float>(0, y), 0) << y;
    EXPECT_EQ(power<float>(1, y), 1) << y;
  }
  EXPECT_EQ(power<float>(0.5f, 1), 0.5f);
  EXPECT_EQ(power<float>(0.5f, 128), std::ldexp(1.0f, -128));
  EXPECT_EQ(power<float>(0.25f, 128), 0) << "2^-256 is below every float";
  EXPECT_EQ(power<float>(std::numeric_limits<float>::min(), 128), 0);
  EXPECT_EQ(power<float>(std::numeric_limits<float>::min(), 0.5f), std::ldexp(1.0f, -63));
  EXPECT_EQ(power<float>(3, 4), 81);
  EXPECT_EQ(power<float>(2, 128), std::ldexp(1.0f, 127)) << "no infinity";
  EXPECT_EQ(power<float>(1e30f, 128), std::ldexp(1.0f, 127));
}

TEST(PipelineMath, PowerOfSubnormals) {
  EXPECT_EQ(power<float>(1e-40f, 1), 1e-40f);
  EXPECT_NEAR(power<float>(1e-40f, 0.01f), std::pow(1e-40, 0.01), 1e-6);
  EXPECT_NEAR(power<float>(std::numeric_limits<float>::denorm_min(), 1e-3f), std::exp2(-0.149), 1e-6);
}

/// One vertex at (0, 0, -2) in eye space, the world's origin, its normal towards the eye; one directional light from
/// +z. All colours of light and material are black until a test sets them.
class PipelineLight : public testing::Test {
 protected:
  PipelineLight() {
    scene_.camera = {{0, 0, 2}, {0, 0, 0}, {0, 1, 0}};
    scene_.lights = {Light{}};
    scene_.meshes.resize(1);
    scene_.lights[0].ambient = scene_.lights[0].diffuse = scene_.lights[0].specular = glm::vec3(0);
    draw_.material = {glm::vec4(0), glm::vec4(0), glm::vec4(0), glm::vec4(0), 0};
  }
  glm::vec4 lit() const {
    std::vector<Attributes> out;
    light({scene_, draw_, scene_.meshes[draw_.mesh], light_sources(scene_), std::span(&vertex_, 1)}, out);
    return out.at(0).color();
  }
  /// Leans the normal from +z towards +x by that angle.
  void tilt(double degrees) { vertex_.n_eye = {std::sin(degrees * M_PI / 180), 0, std::cos(degrees * M_PI / 180)}; }

  Scene scene_;
  Draw draw_;
  Vertex<float> vertex_{{0, 0, -2, 1}, {}, {0, 0, 1}};
};

TEST_F(PipelineLight, DiffuseIsTheCosine) {
  scene_.lights[0].diffuse = {1, 0.5f, 0.25f};
  draw_.material.diffuse = {0.5f, 1, 1, 0.75f};
  tilt(60);
  const glm::vec4 c = lit();
  EXPECT_NEAR(c.r, 0.25, 1e-6);
  EXPECT_NEAR(c.g, 0.25, 1e-6);
  EXPECT_NEAR(c.b, 0.125, 1e-6);
  EXPECT_EQ(c.a, 0.75f) << "the alpha is the diffuse material's";
}

TEST_F(PipelineLight, ADirectionsLengthDoesNotMatter) {
  scene_.lights[0].diffuse = glm::vec3(1);
  draw_.material.diffuse = glm::vec4(1);
  scene_.lights[0].vector = {3, 0, 4};
  EXPECT_NEAR(lit().r, 0.8, 1e-6);
}

TEST_F(PipelineLight, EmissionAndAmbientTermsAddOnceEach) {
  draw_.material.emission = {0.0625f, 0, 0, 9};
  draw_.material.ambient = {0.5f, 0.5f, 0.5f, 9};
  scene_.light_model.ambient = {0.25f, 0.5f, 0};
  scene_.lights[0].ambient = {0.5f, 0, 0.25f};
  EXPECT_EQ(lit(), glm::vec4(0.0625f + 0.125f + 0.25f, 0.25f, 0.125f, 0));
  scene_.lights.push_back(scene_.lights[0]);
  EXPECT_EQ(lit(), glm::vec4(0.0625f + 0.125f + 0.5f, 0.25f, 0.25f, 0));
  scene_.lights.clear();
  EXPECT_EQ(lit(), glm::vec4(0.0625f + 0.125f, 0.25f, 0, 0));
}

TEST_F(PipelineLight, SpecularIsByTheHalfVectorOfAnInfiniteViewer) {
  scene_.lights[0].specular = {1, 0.5f, 1};
  draw_.material.specular = {1, 1, 0.25f, 1};
  draw_.material.shininess = 3;
  scene_.lights[0].vector = {1, 0, 0};  // the half vector of that and +z is at 45 degrees
  tilt(45);
  EXPECT_NEAR(lit().r, 1, 1e-6);
  tilt(15);  // 30 degrees off
  const double expected = std::pow(std::cos(M_PI / 6), 3);
  EXPECT_NEAR(lit().r, expected, 1e-6);
  EXPECT_NEAR(lit().g, expected / 2, 1e-6);
  EXPECT_NEAR(lit().b, expected / 4, 1e-6);
  // The viewer is infinitely far away: where the vertex is does not matter.
  vertex_.p_eye = {5, -3, -20, 1};
  EXPECT_NEAR(lit().r, expected, 1e-6);
}

TEST_F(PipelineLight, ShininessZeroIsOneWhereverTheLightReaches) {
  scene_.lights[0].specular = glm::vec3(1);
  draw_.material.specular = glm::vec4(0.5f);
  tilt(89.9);
  EXPECT_EQ(lit().r, 0.5f);
}

// 1000^128 is beyond double. OpenGL leaves overflow open (2.1, 2.1.1); ours is the largest number, and never a NaN.
TEST_F(PipelineLight, APowerBeyondFloatLeavesTheOtherTerms) {
  scene_.lights[0].specular = glm::vec3(1);
  scene_.lights[0].diffuse = {0, 0.0004f, 0};
  draw_.material = {glm::vec4(0), {0, 1, 0, 1}, {0.5f, 0, 0, 1}, glm::vec4(0), 128};
  vertex_.n_eye = {0, 0, 1000};
  EXPECT_EQ(lit().r, 1);
  EXPECT_NEAR(lit().g, 0.4, 1e-6) << "times a specular term of 0";
  EXPECT_EQ(lit().b, 0);
}

TEST_F(PipelineLight, ANormalThatFacesAwayHasTheAmbientTermAlone) {
  scene_.lights[0] = {Light::Kind::directional, {0, 0, 1}, {0.125f, 0.125f, 0.125f}, glm::vec3(1), glm::vec3(1)};
  draw_.material = {glm::vec4(1), glm::vec4(1), glm::vec4(1), glm::vec4(0), 0};
  for (double degrees : {90.01, 135.0, 180.0}) {
    tilt(degrees);
    EXPECT_EQ(lit(), glm::vec4(0.125f, 0.125f, 0.125f, 1)) << degrees;
  }
  // The half vector is on the normal's side, the light is not: no specular light either.
  scene_.lights[0].vector = {1, 0, 0.1};
  tilt(-30);
  EXPECT_EQ(lit(), glm::vec4(0.125f, 0.125f, 0.125f, 1));
}

TEST_F(PipelineLight, APointLightShinesFromItsPlaceInTheWorld) {
  draw_.material.diffuse = glm::vec4(1);
  scene_.lights[0].kind = Light::Kind::point;
  scene_.lights[0].diffuse = glm::vec3(1);
  scene_.lights[0].vector = {3, 0, 4};  // the vertex is at the world's origin
  EXPECT_NEAR(lit().r, 0.8, 1e-6);
  vertex_.p_eye = {3, 0, -2, 1};  // straight below it
  EXPECT_NEAR(lit().r, 1, 1e-6);
  vertex_.p_eye = {3, 0, 2, 1};  // at its place: there is no direction, and no NaN
  EXPECT_EQ(lit(), glm::vec4(0, 0, 0, 1));
  scene_.lights[0].vector = {0, 0, 1e6};
  EXPECT_NEAR(lit().r, 1, 1e-6) << "no attenuation";
}

TEST_F(PipelineLight, DirectionsTurnWithTheCameraAndDoNotMove) {
  draw_.material.diffuse = glm::vec4(1);
  scene_.lights[0].diffuse = glm::vec3(1);
  scene_.lights[0].vector = {1, 0, 0};
  EXPECT_EQ(lit().r, 0);
  scene_.camera = {{1000, 0, 0}, {0, 0, 0}, {0, 1, 0}};  // the world's +x is the eye's +z
  EXPECT_NEAR(lit().r, 1, 1e-6);
}

TEST_F(PipelineLight, ALightStraightBehindTheSceneHasNoHalfVector) {
  scene_.lights[0] = {Light::Kind::directional, {0, 0, -1}, glm::vec3(0), glm::vec3(0.5f), glm::vec3(1)};
  draw_.material.diffuse = draw_.material.specular = glm::vec4(1);
  draw_.material.shininess = 5;
  vertex_.n_eye = {0, 0, -1};
  EXPECT_EQ(lit(), glm::vec4(0.5f, 0.5f, 0.5f, 1)) << "diffuse light alone, no NaN";
}

TEST_F(PipelineLight, TheSumIsClampedNotItsTerms) {
  draw_.material.diffuse = {1, 1, 1, 7};
  draw_.material.emission = {-0.75f, 0.5f, -2, 1};
  scene_.lights[0].diffuse = {1.5f, 1, 1};
  EXPECT_EQ(lit(), glm::vec4(0.75f, 1, 0, 1));
  draw_.material.diffuse.a = -3;
  EXPECT_EQ(lit().a, 0);
}

TEST_F(PipelineLight, UnlitIsTheMeshColourOrTheMaterialsDiffuse) {
  draw_.lit = false;
  draw_.mesh = 1;
  draw_.material.diffuse = {0.25f, 2, -1, 0.5f};
  draw_.material.emission = glm::vec4(1);
  scene_.light_model.ambient = glm::vec3(1);
  scene_.meshes.resize(2);
  scene_.meshes[0].colors = {{1, 1, 1, 1}};
  EXPECT_EQ(lit(), glm::vec4(0.25f, 1, 0, 0.5f));
  scene_.meshes[1].colors = {{0.5f, -1, 3, 0.25f}};
  EXPECT_EQ(lit(), glm::vec4(0.5f, 0, 1, 0.25f));
}

TEST_F(PipelineLight, EachUnlitVertexHasItsOwnColour) {
  draw_.lit = false;
  scene_.meshes.resize(1);
  scene_.meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  std::vector<Attributes> out;
  light({scene_, draw_, scene_.meshes[draw_.mesh], light_sources(scene_), std::vector(3, vertex_)}, out);
  ASSERT_EQ(out.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(out[i].color(), scene_.meshes[0].colors[i]);
}

TEST_F(PipelineLight, LitMeshesLeaveTheirColoursAside) {
  scene_.meshes.resize(1);
  scene_.meshes[0].colors = {{1, 1, 1, 1}};
  draw_.material.emission = {0.5f, 0, 0, 0};
  draw_.material.diffuse = {0, 0, 0, 1};
  EXPECT_EQ(lit(), glm::vec4(0.5f, 0, 0, 1));
}

TEST_F(PipelineLight, AppendsOneColourPerVertexInOrder) {
  draw_.material.diffuse = glm::vec4(1);
  scene_.lights[0].diffuse = glm::vec3(1);
  const std::vector<Vertex<float>> vertices = {vertex_, {{0, 0, -2, 1}, {}, {0, 0, -1}}};
  std::vector<Attributes> out(1);
  light({scene_, draw_, scene_.meshes[draw_.mesh], light_sources(scene_), vertices}, out);
  ASSERT_EQ(out.size(), 3u);
  EXPECT_EQ(out[1].color(), glm::vec4(1));
  EXPECT_EQ(out[2].color(), glm::vec4(0, 0, 0, 1));
}

}  // namespace
}  // namespace plumbline::pipeline

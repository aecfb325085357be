// Textures drawn by OSMesa, against the filter in double: its levels of detail are those that reference/arithmetic
// states.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "reference/arithmetic/texture.h"
#include "reference/osmesa/osmesa.h"
#include "scene/texture/texture_images.h"
#include "tests/cross/osmesa_scenes.h"

namespace plumbline {
namespace {

constexpr int kSide = 64;

// A frame filled by a square on which (s, t) go from -0.3 `turns` to 0.7 of them.
Scene textured_square(const Sampler& sampler, TextureFormat format, TexelType type, glm::vec2 turns) {
  Scene scene;
  scene.name = "test/texture";
  scene.frame = {kSide, kSide, ColorFormat::rgba32f, DepthFormat::z24, glm::vec4(0), 1};
  scene.camera = {{0, 0, 1}, {0, 0, 0}, {0, 1, 0}};
  scene.projection = Orthographic{-1, 1, -1, 1, 0, 2};
  Texture texture;
  texture.format = format;
  texture.type = type;
  texture.sampler = sampler;
  set_levels(texture, make_noise(64, 64, 3));
  scene.textures.push_back(std::move(texture));
  Mesh mesh = make_grid(1, 1);
  for (glm::vec2& st : mesh.texcoords) st = (st - 0.3f) * turns;
  scene.meshes.push_back(mesh);
  Draw draw;
  draw.lit = false;
  draw.texture = DrawTexture{0, TextureEnvironment::replace, glm::vec4(0)};
  scene.draws.push_back(draw);
  return scene;
}

// The largest difference of OSMesa's texels from those filtered at `lod`.
double largest_difference(const Capture& c, const Scene& scene, glm::vec2 turns, double lod) {
  double largest = 0;
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 st =
          (glm::dvec2(x + 0.5, y + 0.5) / static_cast<double>(kSide) - glm::dvec2(static_cast<double>(0.3f))) *
          glm::dvec2(turns);
      const glm::dvec4 apart =
          glm::abs(math::filtered_texel(scene.textures[0], st, lod) - glm::dvec4(c.planes.texel(x, y)));
      largest = std::max({largest, apart.r, apart.g, apart.b, apart.a});
    }
  }
  return largest;
}

// s and t are below 5, in texels below 320: 2^-24 times that, four times rounded, on the steepest slope of 1 a texel.
constexpr double kTolerance = 4 * 320.0 / 16777216;

TEST(OsmesaTexture, FiltersLinearlyAtLevelsOfALogarithmThatIsLinearBetweenPowers) {
  const auto osmesa = make_opengl();
  for (const MinFilter min : {MinFilter::linear, MinFilter::linear_mipmap_nearest, MinFilter::linear_mipmap_linear}) {
    for (const float turns : {0.5f, 0.77f, 1.0f, 1.5f, 2.0f, 3.3f, 4.0f, 6.1f}) {
      Sampler sampler;
      sampler.min = min;
      sampler.wrap_s = Wrap::mirrored_repeat;
      const glm::vec2 both(turns, turns / 2);
      const Scene scene = textured_square(sampler, TextureFormat::rgba, TexelType::float32, both);
      const double step = static_cast<double>(turns) / kSide;
      const double lod = math::smallest_level_of_detail(scene.textures[0], {step, 0}, {0, step / 2});
      EXPECT_LE(largest_difference(osmesa->capture(scene, {}), scene, both, lod), kTolerance)
          << "filter " << static_cast<int>(min) << ", " << turns << " texels a pixel";
    }
  }
}

TEST(OsmesaTexture, RoundsBiasesToTheNearest256th) {
  const auto osmesa = make_opengl();
  const glm::vec2 turns(3, 1);
  const glm::dvec2 d_dx(3.0 / kSide, 0), d_dy(0, 1.0 / kSide);
  for (const float bias : {1.9f, 1.898f, 0.3f, 0.25f, 0.2519f, 0.0038f, -0.0001f, -0.3f, -0.6f, -0.5f}) {
    Sampler sampler;
    sampler.lod_bias = bias;
    const Scene scene = textured_square(sampler, TextureFormat::rgba, TexelType::float32, turns);
    Texture rounded = scene.textures[0];
    rounded.sampler.lod_bias = std::round(256 * bias) / 256;
    const double lod = math::smallest_level_of_detail(rounded, d_dx, d_dy);
    EXPECT_LE(largest_difference(osmesa->capture(scene, {}), scene, turns, lod), kTolerance) << "a bias of " << bias;
    const double least = math::smallest_level_of_detail(scene.textures[0], d_dx, d_dy),
                 most = math::largest_level_of_detail(scene.textures[0], d_dx, d_dy),
                 ours = math::level_of_detail(scene.textures[0], d_dx, d_dy);
    EXPECT_LE(least, lod) << "a bias of " << bias;
    EXPECT_LE(ours, most) << "a bias of " << bias;
    const double piecewise = ours - static_cast<double>(bias) - (lod - static_cast<double>(rounded.sampler.lod_bias));
    EXPECT_NEAR(most - least, piecewise + std::abs(static_cast<double>(rounded.sampler.lod_bias - bias)), 1e-9)
        << "no wider than the logarithm and the rounded bias";
  }
}

TEST(OsmesaTexture, LevelOfDetailsLeastIsLessThan431HundredThousandthsBelow) {
  const Scene scene = textured_square({}, TextureFormat::rgba, TexelType::float32, {1, 1});
  double largest = 0;
  for (double rho = 1; rho < 4; rho += 1e-3) {
    const glm::dvec2 step(rho / 64, 0);
    const double below = math::level_of_detail(scene.textures[0], step, {0, 0}) -
                         math::smallest_level_of_detail(scene.textures[0], step, {0, 0});
    EXPECT_GE(below, -1e-15);
    largest = std::max(largest, below);
  }
  EXPECT_NEAR(largest, 0.0430356, 1e-6);  // (1/ln 2 - 1 + log2(ln 2)) / 2 - at m = 1/ln 2
}

TEST(OsmesaTexture, FormatsHandOnTheSourceComponentsAndBordersTheirs) {
  const auto osmesa = make_opengl();
  for (int format = 0; format < 6; ++format) {
    for (const TexelType type : {TexelType::unorm8, TexelType::float32}) {
      Sampler sampler;
      sampler.min = MinFilter::linear;
      sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_border;
      sampler.border = {0.9f, 0.6f, 0.3f, 0.2f};
      const Scene scene = textured_square(sampler, static_cast<TextureFormat>(format), type, {2, 2});
      EXPECT_LE(largest_difference(osmesa->capture(scene, {}), scene, {2, 2}, 1), kTolerance)
          << "format " << format << ", type " << static_cast<int>(type);
    }
  }
}

TEST(OsmesaTexture, WrapsAreOurs) {
  const auto osmesa = make_opengl();
  for (int s = 0; s < 4; ++s) {
    for (int t = 0; t < 4; ++t) {
      Sampler sampler;
      sampler.min = MinFilter::linear;
      sampler.wrap_s = static_cast<Wrap>(s);
      sampler.wrap_t = static_cast<Wrap>(t);
      const Scene scene = textured_square(sampler, TextureFormat::rgb, TexelType::unorm8, {4, 3});
      EXPECT_LE(largest_difference(osmesa->capture(scene, {}), scene, {4, 3}, 2), kTolerance) << s << " " << t;
    }
  }
}

}  // namespace
}  // namespace plumbline

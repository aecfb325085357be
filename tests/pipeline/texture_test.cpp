// Stage 8 and the environments of stage 9, by values that OpenGL 2.1's equations and tables give by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "kernels/shade.h"
#include "kernels/texture.h"
#include "scene/texture/texture_images.h"

namespace plumbline::pipeline {
namespace {

Texture texture_of(TextureLevel image, const Sampler& sampler) {
  Texture texture;
  texture.format = TextureFormat::rgba;
  texture.type = TexelType::float32;
  texture.sampler = sampler;
  set_levels(texture, std::move(image));
  return texture;
}

/// n texels in a row, red 0, 1, 2...
TextureLevel ramp(int n) {
  TextureLevel level{n, 1, {}};
  for (int i = 0; i < n; ++i) level.texels.emplace_back(i, 0, 0, 1);
  return level;
}

/// Each level of a size x size texture of one colour: red = its number.
Texture numbered(int size, const Sampler& sampler) {
  Texture texture = texture_of(make_noise(size, size, 1), sampler);
  for (std::size_t i = 0; i < texture.levels.size(); ++i) {
    for (glm::vec4& texel : texture.levels[i].texels) texel = glm::vec4(static_cast<float>(i), 0, 0, 1);
  }
  return texture;
}

float red(const Texture& t, float s, float tt, float lod) {
  return sample<float>(texture_setup(t, t.sampler), {s, tt}, lod).r;
}

Sampler filters(MinFilter min, MagFilter mag, Wrap wrap = Wrap::repeat) {
  Sampler s;
  s.min = min;
  s.mag = mag;
  s.wrap_s = s.wrap_t = wrap;
  return s;
}

TEST(PipelineTexture, NearestIsTheTexelThatTheCoordinateLiesIn) {
  const Texture t = texture_of(ramp(4), filters(MinFilter::nearest, MagFilter::nearest));
  EXPECT_EQ(red(t, 0, 0.5f, 0), 0);
  EXPECT_EQ(red(t, std::nextafter(0.25f, 0.0f), 0.5f, 0), 0);
  EXPECT_EQ(red(t, 0.25f, 0.5f, 0), 1);
  EXPECT_EQ(red(t, 0.9999f, 0.5f, 0), 3);
  EXPECT_EQ(red(t, 1, 0.5f, 0), 0);
  EXPECT_EQ(red(t, -1e-7f, 0.5f, 0), 3);
}

TEST(PipelineTexture, LinearIsExactAtCentresAndHalfwayBetween) {
  const Texture t = texture_of(ramp(4), filters(MinFilter::linear, MagFilter::linear));
  EXPECT_EQ(red(t, 0.125f, 0.5f, 0), 0);
  EXPECT_EQ(red(t, 0.375f, 0.5f, 0), 1);
  EXPECT_EQ(red(t, 0.25f, 0.5f, 0), 0.5f);
  EXPECT_EQ(red(t, 0.3125f, 0.5f, 0), 0.75f);
  EXPECT_EQ(red(t, 0, 0.5f, 0), 1.5f);  // the last and the first
}

TEST(PipelineTexture, LinearMixesFourTexels) {
  const Texture t = texture_of({2, 2, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}},
                               filters(MinFilter::linear, MagFilter::linear, Wrap::clamp_to_edge));
  const Color<float> c =
      sample<float>(texture_setup(t, t.sampler), {0.375f, 0.625f}, 0);  // a quarter right, 3 quarters up
  EXPECT_EQ(c.r, 0.75f * 0.25f);
  EXPECT_EQ(c.g, 0.25f * 0.25f);
  EXPECT_EQ(c.b, 0.75f * 0.75f);
  EXPECT_EQ(c.a, 0.25f * 0.75f);
}

TEST(PipelineTexture, WrapsAreThoseOfTheSpecification) {
  const auto row = [](Wrap wrap) {
    std::vector<double> out;
    for (double i = -5; i < 8; ++i) out.push_back(wrapped(wrap, i, 3.0));
    return out;
  };
  using Row = std::vector<double>;
  EXPECT_EQ(row(Wrap::repeat), (Row{1, 2, 0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 1}));
  EXPECT_EQ(row(Wrap::clamp_to_edge), (Row{0, 0, 0, 0, 0, 0, 1, 2, 2, 2, 2, 2, 2}));
  EXPECT_EQ(row(Wrap::clamp_to_border), (Row{-1, -1, -1, -1, -1, 0, 1, 2, -1, -1, -1, -1, -1}));
}

TEST(PipelineTexture, EveryOtherImageIsMirrored) {
  const std::pair<double, double> places[] = {{0, 0}, {2.5, 2.5},  {3, 3},  {3.25, 2.75}, {5.5, 0.5},  {6, 0},
                                              {7, 1}, {-0.5, 0.5}, {-2, 2}, {-3, 3},      {-3.5, 2.5}, {-6, 0}};
  for (const auto& [s, at] : places) EXPECT_EQ(mirrored(s, 3.0), at) << s;
  const Texture t = texture_of(ramp(3), filters(MinFilter::nearest, MagFilter::nearest, Wrap::mirrored_repeat));
  EXPECT_EQ(red(t, 1.0f, 0.5f, 0), 2);
  EXPECT_EQ(red(t, 1.5f, 0.5f, 0), 1);
  EXPECT_EQ(red(t, -0.25f, 0.5f, 0), 0);
}

TEST(PipelineTexture, TheBorderIsMixedInByItsComponents) {
  Sampler sampler = filters(MinFilter::linear, MagFilter::linear, Wrap::clamp_to_border);
  sampler.border = {0.5f, 0.25f, 0.125f, 0};
  Texture t = texture_of(ramp(4), sampler);
  EXPECT_EQ(red(t, 1, 0.5f, 0), 1.75f);  // half 3, half the border
  EXPECT_EQ(red(t, 2, 0.5f, 0), 0.5f);
  t.format = TextureFormat::luminance;  // the border's red is its luminance, alpha 1
  const Color<float> c = sample<float>(texture_setup(t, t.sampler), {5, 5}, 0);
  EXPECT_EQ(c.b, 0.5f);
  EXPECT_EQ(c.a, 1);
}

TEST(PipelineTexture, LevelsAreChosenAsEquation325Says) {
  const Texture t = numbered(8, filters(MinFilter::nearest_mipmap_nearest, MagFilter::nearest));
  const auto level = [&](float lod) { return red(t, 0.3f, 0.3f, lod); };
  EXPECT_EQ(level(-3), 0);
  EXPECT_EQ(level(0.5f), 0);  // ceil(1) - 1
  EXPECT_EQ(level(0.50001f), 1);
  EXPECT_EQ(level(1.5f), 1);
  EXPECT_EQ(level(1.50001f), 2);
  EXPECT_EQ(level(3.5f), 3);
  EXPECT_EQ(level(99), 3);
}

TEST(PipelineTexture, LinearMipmapsMixTwoLevels) {
  const Texture t = numbered(8, filters(MinFilter::linear_mipmap_linear, MagFilter::linear));
  for (const float lod : {0.0f, 0.25f, 1.0f, 1.875f, 3.0f}) EXPECT_EQ(red(t, 0.3f, 0.3f, lod), lod);
  EXPECT_EQ(red(t, 0.3f, 0.3f, -2), 0);
  EXPECT_EQ(red(t, 0.3f, 0.3f, 3.5f), 3);
}

TEST(PipelineTexture, BaseAndMaximumLevelBoundThem) {
  Sampler sampler = filters(MinFilter::linear_mipmap_linear, MagFilter::linear);
  sampler.base_level = 1;
  sampler.max_level = 3;
  const Texture t = numbered(32, sampler);
  EXPECT_EQ(red(t, 0.3f, 0.3f, -1), 1);
  EXPECT_EQ(red(t, 0.3f, 0.3f, 0.5f), 1.5f);
  EXPECT_EQ(red(t, 0.3f, 0.3f, 9), 3);
  EXPECT_EQ(texture_setup(t, sampler).width, 16);
}

TEST(PipelineTexture, NearestMipmapsTakeOverHalfALevelLater) {
  // c of 3.8.9: linear magnification with a NEAREST_MIPMAP filter
  for (const auto& [min, mag, c] : {std::tuple(MinFilter::nearest_mipmap_nearest, MagFilter::linear, 0.5),
                                    std::tuple(MinFilter::nearest_mipmap_linear, MagFilter::linear, 0.5),
                                    std::tuple(MinFilter::nearest_mipmap_nearest, MagFilter::nearest, 0.0),
                                    std::tuple(MinFilter::linear_mipmap_linear, MagFilter::linear, 0.0),
                                    std::tuple(MinFilter::linear_mipmap_nearest, MagFilter::linear, 0.0),
                                    std::tuple(MinFilter::nearest, MagFilter::linear, 0.0)}) {
    const Texture t = texture_of(ramp(4), filters(min, mag));
    EXPECT_EQ(texture_setup(t, t.sampler).c, c);
  }
  const Texture t = texture_of(ramp(4), filters(MinFilter::nearest_mipmap_linear, MagFilter::linear));
  EXPECT_EQ(red(t, 0.25f, 0.5f, 0.5f), 0.5f);      // magnified: between two texels
  EXPECT_NE(red(t, 0.25f, 0.5f, 0.50001f), 0.5f);  // nearest of levels 0 and 1
}

TEST(PipelineTexture, LevelOfDetailIsLog2OfTheLongerVector) {
  Sampler sampler;
  const Texture t = texture_of(make_noise(64, 32, 1), sampler);
  const auto lod = [&](const Gradients<float>& g) { return level_of_detail<float>(texture_setup(t, t.sampler), g); };
  EXPECT_EQ(lod({1 / 64.0, 0, 0, 1 / 32.0}), 0);
  EXPECT_EQ(lod({4 / 64.0, 0, 0, 1 / 32.0}), 2);
  EXPECT_EQ(lod({0, 0, 0, 8 / 32.0}), 3);
  EXPECT_FLOAT_EQ(lod({3 / 64.0, 4 / 32.0, 0, 0}), std::log2(5.0f));
  EXPECT_EQ(lod({0, 0, 0, 0}), -1000);  // min_lod
  sampler.lod_bias = -0.5f;
  sampler.min_lod = 0.25f;
  sampler.max_lod = 4;
  const Texture limited = texture_of(make_noise(64, 32, 1), sampler);
  const auto bounded = [&](double texels) {
    return level_of_detail<float>(texture_setup(limited, sampler), Gradients<float>{texels / 64, 0, 0, 0});
  };
  EXPECT_EQ(bounded(1), 0.25f);
  EXPECT_EQ(bounded(4), 1.5f);
  EXPECT_EQ(bounded(1000), 4);
}

TEST(PipelineTexture, CoordinatesThatAreNoNumbersDoNoHarm) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge, Wrap::clamp_to_border}) {
    for (const bool linear : {false, true}) {
      const MagFilter mag = linear ? MagFilter::linear : MagFilter::nearest;
      const Texture t = texture_of(make_noise(5, 3, 1), filters(MinFilter::linear_mipmap_linear, mag, wrap));
      for (const float s : {kInfinity, -kInfinity, std::nanf(""), 3e38f, -3e38f}) {
        for (const float lod : {-1.0f, 0.5f, 9.0f}) EXPECT_TRUE(std::isfinite(red(t, s, s, lod)));
      }
    }
  }
}

WindowTriangle triangle(glm::vec3 x_y_w0, glm::vec3 x_y_w1, glm::vec3 x_y_w2) {
  WindowTriangle t{};
  t.front = true;
  const glm::vec3 places[] = {x_y_w0, x_y_w1, x_y_w2};
  for (std::size_t i = 0; i < 3; ++i) {
    t.v[i].p_win = glm::vec3(glm::vec2(places[i]), 0.5f);
    t.v[i].inv_w = 1 / places[i].z;
    t.v[i].snapped = glm::ivec2((glm::vec2(places[i]) - 0.5f) * 256.0f);
  }
  return t;
}

std::array<Vec4<float>, 3> corners(glm::vec2 a, glm::vec2 b, glm::vec2 c) {
  return {Vec4<float>(a, 0, 1), Vec4<float>(b, 0, 1), Vec4<float>(c, 0, 1)};
}

TEST(PipelineTexture, GradientsAreThoseOfTheFunction) {
  // Affine where all w are 1: s = x / 8, t = y / 4 + x / 16
  const WindowTriangle flat = triangle({0, 0, 1}, {8, 0, 1}, {0, 8, 1});
  const GradientSetup f = gradient_setup(flat, corners({0, 0}, {1, 0.5f}, {0, 2}), planes_of(flat, 0, 0));
  const Gradients<float> g = gradients<float>(f, {3, 2}, 1);
  EXPECT_EQ(g.ds_dx, 0.125);
  EXPECT_EQ(g.dt_dx, 0.0625);
  EXPECT_EQ(g.ds_dy, 0);
  EXPECT_EQ(g.dt_dy, 0.25);
  // In perspective: w from 1 at x = 0 to 4 at x = 8, s from 0 to 1: 1/w = 1 - 3x/32, s/w = x/32, s = x / (32 - 3x),
  // ds/dx = 32 / (32 - 3x)^2, and times q^2 = (32 - 3x)^2 / 32^2 it is 1/32 everywhere
  const WindowTriangle deep = triangle({0, 0, 1}, {8, 0, 4}, {0, 8, 1});
  const GradientSetup d = gradient_setup(deep, corners({0, 0}, {1, 0}, {0, 0}), planes_of(deep, 0, 0));
  for (const double x : {0.5, 2.5, 6.5}) {
    const double q = 1 - 3 * x / 32;
    const Gradients<float> p = gradients<float>(d, {x - 0.5, 0}, q);
    EXPECT_NEAR(p.ds_dx / (q * q), 32 / ((32 - 3 * x) * (32 - 3 * x)), 1e-15);
    EXPECT_NEAR(p.ds_dy, 0, 1e-15);
  }
}

// Tables 3.22 and 3.23: for each format, environment by environment, what becomes of Cf, Af, Cs, As, Cc, Ac.
TEST(PipelineEnvironment, IsThatOfTheTables) {
  const float cf = 0.5f, af = 0.25f, cs = 0.75f, as = 0.125f, cc = 0.375f, ac = 0.875f;
  const float blended = cf * (1 - cs) + cc * cs, sum = 1;  // 1.25, clamped
  struct Row {
    TextureFormat format;
    TextureEnvironment environment;
    float c, a;
  };
  using F = TextureFormat;
  using E = TextureEnvironment;
  const Row rows[] = {
      {F::alpha, E::replace, cf, as},
      {F::luminance, E::replace, cs, af},
      {F::luminance_alpha, E::replace, cs, as},
      {F::intensity, E::replace, cs, as},
      {F::rgb, E::replace, cs, af},
      {F::rgba, E::replace, cs, as},
      {F::alpha, E::modulate, cf, af * as},
      {F::luminance, E::modulate, cf * cs, af},
      {F::luminance_alpha, E::modulate, cf * cs, af * as},
      {F::intensity, E::modulate, cf * cs, af * as},
      {F::rgb, E::modulate, cf * cs, af},
      {F::rgba, E::modulate, cf * cs, af * as},
      {F::rgb, E::decal, cs, af},
      {F::rgba, E::decal, cf * (1 - as) + cs * as, af},
      {F::alpha, E::blend, cf, af * as},
      {F::luminance, E::blend, blended, af},
      {F::luminance_alpha, E::blend, blended, af * as},
      {F::intensity, E::blend, blended, af * (1 - as) + ac * as},
      {F::rgb, E::blend, blended, af},
      {F::rgba, E::blend, blended, af * as},
      {F::alpha, E::add, cf, af * as},
      {F::luminance, E::add, sum, af},
      {F::luminance_alpha, E::add, sum, af * as},
      {F::intensity, E::add, sum, af + as},
      {F::rgb, E::add, sum, af},
      {F::rgba, E::add, sum, af * as},
  };
  for (const Row& row : rows) {
    const DrawTexture state{0, row.environment, glm::vec4(cc, cc, cc, ac)};
    const Color<float> out = apply_environment<float>(row.format, state, {cf, cf, cf, af}, {cs, cs, cs, as});
    const std::string what =
        fmt::format("format {}, environment {}", static_cast<int>(row.format), static_cast<int>(row.environment));
    EXPECT_EQ(out.r, row.c) << what;
    EXPECT_EQ(out.g, row.c) << what;
    EXPECT_EQ(out.b, row.c) << what;
    EXPECT_EQ(out.a, row.a) << what;
  }
}

}  // namespace
}  // namespace plumbline::pipeline

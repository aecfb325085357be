// Comparators of textures: what must pass, what must fail, and the bounds that they grant.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "check/bounds.h"
#include "check/compare_texels.h"
#include "check/texture_bounds.h"
#include "reference/math/texture.h"
#include "scene/texture_images.h"

namespace plumbline::check {
namespace {

constexpr double u = kUnitRoundoff;

Texture noise(MinFilter min, int size = 16) {
  Texture texture;
  texture.format = TextureFormat::rgba;
  texture.sampler.min = min;
  texture.sampler.mag = min == MinFilter::nearest ? MagFilter::nearest : MagFilter::linear;
  set_levels(texture, make_noise(size, size, 1));
  return texture;
}

struct Two {
  Scene scene;
  Records<double> mine, theirs;
};

Two equal_texels() {
  Two two;
  two.scene.textures.push_back(noise(MinFilter::linear));
  two.mine.covered = {{0, 1, 2}, {0, 2, 2}};
  two.mine.texels = {{{0.5, 0.25, 1, 1}, 1.5}, {{0, 0, 0, 1}, -0.5}};
  two.theirs = two.mine;
  return two;
}

TEST(CompareTexels, GrantsTheFactorAndNoMore) {
  Two two = equal_texels();
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).max_difference, 0);
  two.mine.texels[0].color.g += 3 * u;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 0u);
  two.mine.texels[0].color.g += 0.1 * u;
  const Measurement m = compare_texels(two.scene, two.mine, two.theirs, 3);
  EXPECT_EQ(m.differing, 1u);
  EXPECT_STREQ(m.worst.place.field, "texel");
  EXPECT_EQ(m.worst.place.x, 1);
}

TEST(CompareTexels, JudgesTheLevelOfDetail) {
  Two two = equal_texels();
  two.mine.texels[0].lod += 4.4 * u;  // 3 u of 1.5
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 0u);
  two.mine.texels[0].lod += 1e-3;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 1u);
  two = equal_texels();
  two.mine.texels[1].lod = -498;  // the logarithm of next to nothing
  two.theirs.texels[1].lod = -1000;
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 0u);
}

TEST(CompareTexels, RefusesWhatIsNoNumberOrLacking) {
  Two two = equal_texels();
  two.mine.texels[1].color.r = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(compare_texels(two.scene, two.mine, two.theirs, 3).differing, 1u);
  two = equal_texels();
  two.mine.texels.pop_back();
  EXPECT_FALSE(compare_texels(two.scene, two.mine, two.theirs, 3).mismatch.empty());
}

TEST(TexelBound, HoldsWhereverThePlaceMayBe) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-2, 2), level(-1, 3), share(-1, 1);
  int open = 0;
  for (int round = 0; round < 4000; ++round) {
    const auto min = static_cast<MinFilter>(round % 6);
    const Texture texture = noise(min);
    const glm::dvec2 st(coordinate(random), coordinate(random)), error(0.003, 0.002);
    const double lo = level(random), hi = lo + 0.2;
    const TexelBound bound = texel_bound(texture, math::texel_range(texture, st, lo, hi), st, error, 8);
    open += std::isinf(bound.slack.r) ? 1 : 0;
    for (int i = 0; i < 20; ++i) {
      const glm::dvec2 at = st + error * glm::dvec2(share(random), share(random));
      const double lambda = lo + 0.1 * (1 + share(random));
      const glm::dvec4 texel = math::filtered_texel(texture, at, lambda);
      for (int c = 0; c < 4; ++c) {
        ASSERT_GE(texel[c], bound.range.lo[c] - bound.slack[c]) << static_cast<int>(min) << " " << lambda;
        ASSERT_LE(texel[c], bound.range.hi[c] + bound.slack[c]) << static_cast<int>(min) << " " << lambda;
      }
    }
  }
  EXPECT_GT(open, 0);
  EXPECT_LT(open, 1000);
}

TEST(TexelBound, IsTightOnARamp) {
  Texture texture = noise(MinFilter::linear);
  TextureLevel ramp{16, 1, {}};
  for (int i = 0; i < 16; ++i) ramp.texels.emplace_back(static_cast<float>(i) / 16, 0, 0, 1);
  texture.type = TexelType::float32;
  set_levels(texture, ramp);
  const TexelBound bound =
      texel_bound(texture, math::texel_range(texture, {0.5, 0.5}, -1, -1), {0.5, 0.5}, {0.01, 0}, 0);
  EXPECT_NEAR(bound.slack.r, 0.01, 4 * u);  // red is s
  EXPECT_NEAR(bound.slack.g, 0, 1e-12);
}

TEST(EnvironError, HoldsForAllThatMayComeIn) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1), share(-1, 1);
  const auto color = [&](auto& of) { return glm::dvec4(of(random), of(random), of(random), of(random)); };
  for (int round = 0; round < 20000; ++round) {
    const auto format = static_cast<TextureFormat>(random() % 6);
    const auto environment = static_cast<TextureEnvironment>(random() % 5);
    if (environment == TextureEnvironment::decal && format < TextureFormat::rgb) continue;
    const DrawTexture state{0, environment, glm::vec4(color(unit))};
    const glm::dvec4 f = color(unit), s = glm::dvec4(source_components(format, glm::vec4(color(unit))));
    const glm::dvec4 f_error = 0.1 * color(unit), s_error = 0.1 * color(unit);
    const Environed e = environ_error(format, state, f, f_error, s, s_error, 0);
    const glm::dvec4 middle = math::textured_color(format, state, f, s);
    const glm::dvec4 moved =
        math::textured_color(format, state, f + f_error * color(share), s + s_error * color(share));
    for (int c = 0; c < 4; ++c) {
      ASSERT_NEAR(e.color[c], middle[c], 1e-15);
      ASSERT_LE(std::abs(moved[c] - middle[c]), e.error[c] + 1e-15)
          << static_cast<int>(format) << " " << static_cast<int>(environment);
    }
  }
}

TEST(EnvironError, IsZeroWhereNothingIsOff) {
  const glm::dvec4 c(0.5, 0.25, 0.75, 1), zero(0);
  const DrawTexture state{0, TextureEnvironment::replace, glm::vec4(0)};
  EXPECT_EQ(environ_error(TextureFormat::rgba, state, c, zero, c, zero, 1).error, zero) << "nothing is computed";
}

}  // namespace
}  // namespace plumbline::check

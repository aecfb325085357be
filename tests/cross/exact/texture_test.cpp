// Our filter and exact's, two transcriptions of one specification, on random textures, coordinates and levels.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "kernels/shade.h"
#include "kernels/texture.h"
#include "reference/arithmetic/texture.h"
#include "scene/texture/texture_images.h"

namespace plumbline {
namespace {

template <class E>
E any_of(std::mt19937& random, int count) {
  return static_cast<E>(std::uniform_int_distribution<int>(0, count - 1)(random));
}

Texture random_texture(std::mt19937& random) {
  std::uniform_int_distribution<int> side(1, 40);
  Texture texture;
  texture.format = any_of<TextureFormat>(random, 6);
  texture.type = any_of<TexelType>(random, 2);
  Sampler& s = texture.sampler;
  s.min = any_of<MinFilter>(random, 6);
  s.mag = any_of<MagFilter>(random, 2);
  s.wrap_s = any_of<Wrap>(random, 4);
  s.wrap_t = any_of<Wrap>(random, 4);
  s.border = {0.1f, 0.9f, 0.4f, 0.7f};
  set_levels(texture, make_noise(side(random), side(random), static_cast<std::uint32_t>(random())));
  s.base_level = std::uniform_int_distribution<int>(0, static_cast<int>(texture.levels.size()) - 1)(random);
  s.max_level = s.base_level + std::uniform_int_distribution<int>(0, 4)(random);
  return texture;
}

TEST(ExactTexture, FiltersAsThePipelineDoes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> coordinate(-3, 3), level(-2, 8);
  double largest = 0;
  for (int round = 0; round < 2000; ++round) {
    const Texture texture = random_texture(random);
    const auto setup = pipeline::texture_setup(texture, texture.sampler);
    for (int i = 0; i < 50; ++i) {
      // Multiples of 1/64 as well: on texels' centres and borders, and on the levels' own limits
      const bool grid = i % 2 == 0;
      const auto at = [&](float value) { return grid ? std::round(value * 64) / 64 : value; };
      const float s = at(coordinate(random)), t = at(coordinate(random)), lod = at(level(random));
      const pipeline::Color<float> ours = pipeline::sample(setup, {s, t}, lod);
      const glm::dvec4 exact = math::filtered_texel(texture, glm::dvec2(s, t), lod);
      const glm::dvec4 apart = glm::abs(glm::dvec4(ours.r, ours.g, ours.b, ours.a) - exact);
      largest = std::max({largest, apart.r, apart.g, apart.b, apart.a});
      ASSERT_LE(std::max({apart.r, apart.g, apart.b, apart.a}), 4 * 0x1p-24)
          << "s " << s << " t " << t << " lod " << lod << " of " << texture.levels[0].width << " x "
          << texture.levels[0].height << " min " << static_cast<int>(texture.sampler.min) << " mag "
          << static_cast<int>(texture.sampler.mag) << " wraps " << static_cast<int>(texture.sampler.wrap_s) << " "
          << static_cast<int>(texture.sampler.wrap_t);
    }
  }
  RecordProperty("largest", std::to_string(largest * 0x1p24) + " u");
}

TEST(ExactTexture, EnvironmentsAreThePipelines) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto color = [&] { return glm::vec4{unit(random), unit(random), unit(random), unit(random)}; };
  for (int round = 0; round < 20000; ++round) {
    const auto format = any_of<TextureFormat>(random, 6);
    const auto environment = any_of<TextureEnvironment>(random, 5);
    if (environment == TextureEnvironment::decal && format < TextureFormat::rgb) continue;
    const DrawTexture state{0, environment, color()};
    const glm::vec4 f = color(), s = source_components(format, color());
    const auto ours = pipeline::apply_environment<float>(format, state, {f.r, f.g, f.b, f.a}, {s.r, s.g, s.b, s.a});
    const glm::dvec4 exact = math::textured_color(format, state, glm::dvec4(f), glm::dvec4(s));
    const glm::dvec4 apart = glm::abs(glm::dvec4(ours.r, ours.g, ours.b, ours.a) - exact);
    ASSERT_LE(std::max({apart.r, apart.g, apart.b, apart.a}), 3 * 0x1p-24)
        << static_cast<int>(format) << " " << static_cast<int>(environment);
  }
}

}  // namespace
}  // namespace plumbline

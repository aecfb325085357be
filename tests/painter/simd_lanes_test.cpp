// Each lane of every SIMD target does what float does, bit for bit, with numbers that no scene has as well.
#include <gtest/gtest.h>

#include <bit>
#include <limits>
#include <random>

#include "painter/painter.h"
#include "pipeline/geometry.h"
#include "scene/texture/texture_images.h"
#include "tests/painter/lanes_kernels.h"

namespace plumbline::pipeline {
namespace {

using Numbers = std::vector<float>;
using Limits = std::numeric_limits<float>;

/// Numbers of a range; one in eight is any float, or one of those where functions turn.
class Source {
 public:
  float operator()(float low, float high) {
    static constexpr float kTurns[] = {0.0f,
                                       -0.0f,
                                       0.5f,
                                       1.0f,
                                       -1.0f,
                                       2.0f,
                                       255.0f,
                                       0x1p23f,
                                       0x1p31f,
                                       -0x1p31f,
                                       0x1p40f,
                                       0x1p100f,
                                       -0x1p126f,
                                       Limits::min(),
                                       Limits::denorm_min(),
                                       -Limits::denorm_min(),
                                       Limits::max(),
                                       Limits::lowest(),
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       Limits::quiet_NaN()};
    switch (random_() % 16) {
      case 0: return kTurns[random_() % std::size(kTurns)];
      case 1: return std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      default: return std::uniform_real_distribution<float>(low, high)(random_);
    }
  }
  void fill(Numbers& numbers, std::size_t columns, float low, float high) {
    for (std::size_t i = 0; i < columns * kItems; ++i) numbers.push_back((*this)(low, high));
  }

 private:
  std::mt19937 random_{1};
};

std::vector<std::pair<std::string, Kernels>> kernels_of_targets() {
  std::vector<std::pair<std::string, Kernels>> out;
  for (const SimdTarget& target : simd_targets().subspan(1)) {
    const auto kernels = target.name == "sse4" ? kernels_sse4 : target.name == "avx2" ? kernels_avx2 : kernels_avx512;
    out.emplace_back(target.name, kernels());
  }
  return out;
}

/// `run(kernels, out)`, for `columns` numbers of each item.
void expect_same(std::size_t columns, const Numbers& in, const std::string& what, auto run) {
  Numbers definition(columns * kItems);
  run(kernels<float>(), definition.data());
  for (const auto& [name, kernels] : kernels_of_targets()) {
    Numbers out(columns * kItems);
    run(kernels, out.data());
    for (std::size_t i = 0; i < out.size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(out[i]), std::bit_cast<std::uint32_t>(definition[i]))
          << what << ", " << name << ": " << out[i] << ", not " << definition[i] << ", number " << i / kItems << " of "
          << testing::PrintToString([&] {
               Numbers item;
               for (std::size_t k = i % kItems; k < in.size(); k += kItems) item.push_back(in[k]);
               return item;
             }());
    }
  }
}

TEST(SimdLanes, EachDoesAsFloatDoes) {
  Source source;
  for (const float most : {1.0f, 40.0f, 1e6f, 1e30f}) {
    Numbers in;
    source.fill(in, 2, -most, most);
    expect_same(kWords, in, "words", [&](const Kernels& k, float* out) { k.words(kItems, in.data(), out); });
  }
}

TEST(SimdLanes, SampleTexturesAsFloatDoes) {
  Source source;
  Numbers in;
  source.fill(in, 2, -3, 3);
  source.fill(in, 1, -2, 9);
  for (float& lod : std::span(in).last(kItems)) lod = lod == lod ? lod : 0;
  for (const glm::ivec2 size : {glm::ivec2(16, 64), glm::ivec2(12, 7), glm::ivec2(1, 1)}) {
    Texture texture;
    texture.format = TextureFormat::rgba;
    texture.type = TexelType::float32;
    set_levels(texture, make_noise(size.x, size.y, 1));
    for (int state = 0; state < 6 * 2 * 16 * 2; ++state) {
      Sampler& s = texture.sampler;
      s.min = static_cast<MinFilter>(state % 6);
      s.mag = static_cast<MagFilter>(state / 6 % 2);
      s.wrap_s = static_cast<Wrap>(state / 12 % 4);
      s.wrap_t = static_cast<Wrap>(state / 48 % 4);
      s.base_level = size.x > 1 ? state / 192 : 0;
      s.border = {0.1f, 0.2f, 0.3f, 0.4f};
      const TextureSetup setup = texture_setup(texture, s);
      expect_same(4, in, "state " + std::to_string(state),
                  [&](const Kernels& k, float* out) { k.sample(setup, kItems, in.data(), out); });
    }
  }
}

TEST(SimdLanes, LightAsFloatDoes) {
  Source source;
  Numbers in;
  source.fill(in, 4, 0, 1);
  source.fill(in, 3, -1, 1);
  source.fill(in, 3, -3, 3);
  Scene scene;
  scene.meshes.emplace_back().colors = {glm::vec4(1)};
  Draw draw;
  draw.material.specular = {0.5f, 0.25f, 1, 1};
  draw.material.shininess = 12.5f;
  Light light;
  light.vector = {1, 2, 3};
  scene.lights.push_back(light);
  light.kind = Light::Kind::point;
  light.attenuation = {0.5f, 0.25f, 0.125f};
  scene.lights.push_back(light);
  light.spot = Spot{};
  light.spot->direction = {-1, -2, -3.5};
  light.spot->cutoff_degrees = 40;
  light.spot->exponent = 3;
  scene.lights.push_back(light);
  for (int state = 0; state < 6 * 3 * 32; ++state) {
    draw.color_material = static_cast<ColorMaterial>(state % 6);
    scene.light_model.sides = static_cast<LightModel::Sides>(state / 6 % 3);
    scene.light_model.specular = static_cast<LightModel::Specular>(state / 18 % 2);
    scene.light_model.local_viewer = state / 36 % 2 == 1;
    scene.light_model.separate_specular = state / 72 % 2 == 1;
    const LitPart part{state / 144 % 2 == 1, scene.light_model.separate_specular && state / 288 % 2 == 1};
    const FragmentLight lights = fragment_light(scene, draw, light_sources(scene));
    expect_same(4, in, "state " + std::to_string(state),
                [&](const Kernels& k, float* out) { k.lit(lights, part, kItems, in.data(), out); });
  }
}

TEST(SimdLanes, BlendAsFloatDoes) {
  Source source;
  for (const float scale : {0.0f, 255.0f, 4095.0f, 65535.0f}) {
    Numbers in;
    source.fill(in, 4, -0.5f, 1.5f);
    if (scale == 0) {
      source.fill(in, 4, -2, 2);
    } else {
      std::mt19937 random(2);
      for (std::size_t i = 0; i < 4 * kItems; ++i)
        in.push_back(static_cast<float>(random() % (static_cast<unsigned>(scale) + 1)));
    }
    for (int state = 0; state < 15 * 15; ++state) {
      const BlendTerm rgb{static_cast<BlendFactor>(state % 15), static_cast<BlendFactor>(state / 15),
                          static_cast<BlendEquation>(state % 5)};
      const BlendTerm alpha{rgb.destination, rgb.source, static_cast<BlendEquation>(state % 4)};
      const Blend blend{rgb, state % 2 == 0 ? alpha : rgb, {0.1f, 0.2f, 0.3f, 0.4f}};
      expect_same(4, in, "state " + std::to_string(state),
                  [&](const Kernels& k, float* out) { k.blend(blend, scale, kItems, in.data(), out); });
    }
  }
}

}  // namespace
}  // namespace plumbline::pipeline

// Conventions of textures and polygon offsets that OpenGL leaves open, found in our renderer drawn by them.
#include <algorithm>

#include "tests/learn/altered_renderers.h"
#include "tests/learn/drawn_otherwise.h"

namespace plumbline::learn {
namespace {

C learned_by(decltype(pipeline::Stages::texture) texture) {
  pipeline::Stages stages = pipeline::production_stages();
  stages.texture = texture;
  return learned(pipeline::make_pipeline(stages));
}

// Samples at pixels' lower left corners: those of the first column and row lie on the frame's sides, and are nobody's.
TEST(LearnTextures, SamplesOnSidesThatAreNobodysAreNoTexels) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) { scene.frame.pass.shift += 0.5; };
  renderer.after = [](const Scene&, Capture& c) {
    for (int i = 0; i < std::min(c.width, c.height); ++i)
      c.planes.color(0, i) = c.planes.color(i, 0) = glm::vec4(0, 0, 0, 1);
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.sample, glm::dvec2(0));
  EXPECT_EQ(found.texture_bits, C::kFloat);
  EXPECT_EQ(std::ranges::count(found.open, "texture_bits"), 0);
  EXPECT_EQ(found.level_of_detail, C::LevelOfDetail::per_pixel);
}

TEST(LearnTextures, LevelsOfDetailThatAreApproximatedAreFound) {
  C expected = ours();
  expected.level_of_detail = C::LevelOfDetail::approximate;
  EXPECT_EQ(learned_by(test::by_largest_rho), expected);
}

TEST(LearnTextures, TheEndOfMagnificationIsFound) {
  C expected = ours();
  expected.magnified = C::Magnified::up_to_zero;
  EXPECT_EQ(learned_by(test::magnified_up_to_zero), expected);
  const auto exchanged = faults::named("texture.weights_exchanged").stages().texture;
  EXPECT_EQ(learned_by(exchanged).magnified, C::Magnified::up_to_half) << "whatever the weights";
}

TEST(LearnTextures, LevelsHalfWayAreFound) {
  C expected = ours();
  expected.half_way_level = C::HalfWay::either;
  EXPECT_EQ(learned_by(test::half_way_up), expected);
}

TEST(LearnTextures, WeightsOfFewBitsAreFound) {
  C found = learned_by(test::weights_of_bits<>);
  EXPECT_GE(found.texture_bits, 6);
  EXPECT_LE(found.texture_bits, 8) << "rounded to nearest, a weight is half a step off, and no mean is rounded";
  found.texture_bits = C::kFloat;
  EXPECT_EQ(found, ours());
}

// A weight is off by up to a whole step.
TEST(LearnTextures, TruncatedWeightsAreOfTheirBits) {
  EXPECT_EQ(learned_by(test::weights_of_bits<5, test::towards_0>).texture_bits, 5);
  EXPECT_EQ(learned_by(test::weights_of_bits<6, test::towards_0>).texture_bits, 6);
  EXPECT_EQ(learned_by(test::weights_of_bits<8, test::towards_0>).texture_bits, 8);
}

// Filters whose errors are those of few bits in size, and not in form.
TEST(LearnTextures, CurvesAndOffsetsAreNoWeightsOfFewBits) {
  const auto says = [](decltype(pipeline::Stages::texture) texture) {
    pipeline::Stages stages = pipeline::production_stages();
    stages.texture = texture;
    const auto renderer = pipeline::make_pipeline(stages);
    const Learned found = learn(*renderer);
    EXPECT_EQ(std::ranges::count(found.conventions.open, "texture_bits"), 1);
    const auto row = std::ranges::find(found.rows, "texture_bits", &LearnedRow::name);
    return row == found.rows.end() ? "" : row->evidence;
  };
  EXPECT_NE(says(test::smooth_weights).find("no rounding"), std::string::npos);
  EXPECT_NE(says(test::moved_by_a_texels_part).find("no rounding"), std::string::npos);
}

// Texels of 5, 6 and 5 bits, or upside down, filtered with weights in float.
TEST(LearnTextures, WrongTexelsAreNoWeightsOfFewBits) {
  const auto says = [](void (*alter)(std::vector<glm::vec4>&), const std::string& text) {
    OfAlteredScenes renderer;
    renderer.before = [alter](Scene& scene) {
      for (Texture& texture : scene.textures)
        for (TextureLevel& level : texture.levels) alter(level.texels);
    };
    const C found = learn(renderer).conventions;
    EXPECT_EQ(found.texture_bits, C::kFloat);
    return std::ranges::any_of(found.unexplained,
                               [&](const std::string& finding) { return finding.find(text) != std::string::npos; });
  };
  const auto of_few_bits = [](std::vector<glm::vec4>& texels) {
    const auto kept = [](float& channel, float codes) { channel = std::floor(channel * codes + 0.5f) / codes; };
    for (glm::vec4& texel : texels) kept(texel.r, 31), kept(texel.g, 63), kept(texel.b, 31);
  };
  const auto turned = [](std::vector<glm::vec4>& texels) { std::ranges::reverse(texels); };
  EXPECT_TRUE(says(of_few_bits, "they are kept in fewer bits"));
  EXPECT_TRUE(says(turned, "others are taken"));
}

}  // namespace
}  // namespace plumbline::learn

// Fog factors, and the numbers of fragments' colours, that plumb learn finds.
#include <algorithm>
#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "tests/learn/altered_renderers.h"
#include "tests/learn/other_colors.h"

namespace plumbline::learn {
namespace {

// Stage shade in fog of half the distance.
pipeline::Shaded shade_by_half(const pipeline::Surface& surface, bool front,
                               const pipeline::SurfaceAttributes<float>& attributes) {
  pipeline::SurfaceAttributes<float> other = attributes;
  pipeline::Color<float>& p = other[Varying::position];
  p.b /= 2;
  return {pipeline::shade<float>(surface, front, other)};
}

// Mixes of encoded colours are not judged by linear ones.
TEST(LearnColors, EncodedOnesLeaveWhatMixesColoursOpen) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) { scene.frame.color = ColorFormat::rgba32f; };
  renderer.after = [](const Scene&, Capture& out) {
    for (glm::vec4& color : out.planes.color.values()) {
      for (glm::length_t c = 0; c < 3; ++c)
        color[c] = static_cast<float>(std::nearbyint(255 * srgb_encoded(static_cast<double>(color[c]))) / 255);
    }
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.color_encoding, C::Encoding::srgb);
  EXPECT_EQ(found.provoking_vertex, C::Provoking::last);
  EXPECT_THAT(found.unexplained, testing::IsEmpty());
  EXPECT_THAT(found.open, testing::IsSupersetOf({"blending", "texture_bits", "fragment_colors", "level_of_detail",
                                                 "half_way_level", "interpolation", "fog_factor", "fog_distance"}));
}

float code_above(float v, float scale) { return std::ceil(std::clamp(v, 0.0f, 1.0f) * scale - 1e-4f); }

// Blends in float over codes that are rounded up.
TEST(LearnColors, RoundedUpMayBeBlendedInFloat) {
  pipeline::Stages stages = pipeline::production_stages();
  stages.merge = [](const pipeline::Color<float>& c, float scale) -> pipeline::Color<float> {
    return {code_above(c.r, scale), code_above(c.g, scale), code_above(c.b, scale), code_above(c.a, scale)};
  };
  stages.blend = [](const Blend&, const pipeline::Color<float>& over, const pipeline::Color<float>& stored,
                    float scale) -> pipeline::Color<float> {
    const auto mixed = [&](float c, float under) {
      return code_above(over.a * c + (1 - over.a) * under / scale, scale);
    };
    return {mixed(over.r, stored.r), mixed(over.g, stored.g), mixed(over.b, stored.b), mixed(over.a, stored.a)};
  };
  const C found = learned(pipeline::make_pipeline(stages));
  EXPECT_EQ(found.color_rounding, C::Rounding::up);
  EXPECT_EQ(found.blending, C::Blending::in_float);
}

TEST(LearnFog, FactorsOfVerticesAreFound) {
  C expected = ours();
  EXPECT_EQ(learned(pipeline::make_pipeline()), expected);
  expected.fog_factor = C::FogFactor::per_vertex;
  EXPECT_EQ(learned(test::make_fog_by_vertices<pipeline::fog_factor<float>>()), expected);
  expected.fog_distance = C::FogDistance::eye_radial;
  EXPECT_EQ(learned(test::make_fog_by_vertices<pipeline::fog_factor<float>, test::length_of>()), expected);
  expected.fog_factor = C::FogFactor::per_fragment;
  EXPECT_EQ(learned(test::make_radial_fog()), expected);
}

TEST(LearnFragmentColors, CodesAreFound) {
  C expected = ours();
  expected.fragment_colors = C::ColorNumbers::in_codes;
  EXPECT_EQ(learned(pipeline::make_pipeline(test::stages_in_codes())), expected);
}

// Blending in integers: factors are the nearest codes, and products are rounded. `stored` holds codes.
template <double (*whole)(double)>
pipeline::Color<float> blend_in_codes(const Blend& state, const pipeline::Color<float>& source,
                                      const pipeline::Color<float>& stored, float) {
  const auto code = [](float v) { return std::nearbyint(255.0 * static_cast<double>(v)); };
  const double a = code(source.a);
  const auto blended = [&](float s, float d) {
    const double sum = whole(code(s) * a / 255) + whole(static_cast<double>(d) * (255 - a) / 255);
    return static_cast<float>(std::min(sum, 255.0));
  };
  EXPECT_EQ(state.rgb.source, BlendFactor::source_alpha);
  return {blended(source.r, stored.r), blended(source.g, stored.g), blended(source.b, stored.b),
          blended(source.a, stored.a)};
}

TEST(LearnAlpha, AFrameMayHaveNone) {
  const auto found = [](auto alpha_of) {
    return learned(std::make_unique<Altered>(pipeline::make_pipeline(), [=](Capture& c) {
      for (glm::vec4& color : c.planes.color.values()) color.a = alpha_of(color.a);
    }));
  };
  EXPECT_EQ(found([](float a) { return a; }).alpha, C::Alpha::stored);
  EXPECT_EQ(found([](float) { return 1.0f; }).alpha, C::Alpha::none);
  EXPECT_EQ(found([](float) { return 0.0f; }).alpha, C::Alpha::none);
  EXPECT_THAT(found([](float a) { return 1 - a; }).unexplained,
              testing::Contains(testing::HasSubstr("alpha: alphas of 1/4 and 3/4 are left as 0.749")));
}

TEST(LearnBlending, ProductsMayBeRoundedDownAlone) {
  const auto found = [](auto blend) {
    pipeline::Stages stages = pipeline::production_stages();
    stages.blend = blend;
    return learned(pipeline::make_pipeline(stages)).blending;
  };
  EXPECT_EQ(found(blend_in_codes<std::floor>), C::Blending::in_codes_down);
  EXPECT_EQ(found(blend_in_codes<std::nearbyint>), C::Blending::in_codes);
}

TEST(LearnInterpolation, ColoursAloneMayBeAffine) {
  C expected = ours();
  expected.color_interpolation = C::ColorInterpolation::affine;
  EXPECT_EQ(learned(test::make_affine_colors()), expected);
  const C found = learned(test::make_affine_colors<false>());
  EXPECT_EQ(found.interpolation, C::Interpolation::affine);
  EXPECT_EQ(found.color_interpolation, C::ColorInterpolation::perspective);
}

// Affine colours of a renderer that draws no texture leave other attributes open.
TEST(LearnInterpolation, AffineColorsSayNothingOfOtherAttributes) {
  OfAlteredScenes renderer(test::make_affine_colors());
  renderer.before = [](Scene& scene) {
    if (!scene.textures.empty()) throw Unsupported("textures");
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.color_interpolation, C::ColorInterpolation::affine);
  EXPECT_EQ(std::ranges::count(found.open, "interpolation"), 1);
}

// Colours of vertices are rounded to the nearest codes, those between them down: integers divided by the area.
TEST(LearnVertexColors, FragmentsMayBeRoundedOtherwise) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    scene.frame.color = ColorFormat::rgba32f;
    for (Mesh& mesh : scene.meshes) {
      for (glm::vec4& color : mesh.colors) color = glm::round(255.0f * color) / 255.0f;
    }
  };
  renderer.after = [](const Scene&, Capture& c) {
    for (glm::vec4& color : c.planes.color.values()) color = glm::floor(255.0f * color + 0.001f) / 255.0f;
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.vertex_colors, C::ColorNumbers::in_codes);
  EXPECT_EQ(found.color_rounding, C::Rounding::down);
  EXPECT_FALSE(std::ranges::count(found.open, "color_rounding"));
}

TEST(LearnVertexColors, CodesAreFound) {
  C expected = ours();
  expected.vertex_colors = C::ColorNumbers::in_codes;
  EXPECT_EQ(learned(test::make_vertices_in_codes()), expected);
}

// Products that are shifted for divided: (a * b) >> 8.
TEST(LearnFragmentColors, OtherProductsAreAFinding) {
  pipeline::Stages stages = test::stages_in_codes();
  stages.shade = [](const pipeline::Surface& surface, bool front,
                    const pipeline::SurfaceAttributes<float>& attributes) -> pipeline::Shaded {
    const pipeline::Color<float> right = test::shade_in_codes(surface, front, attributes).color;
    if (!surface.texture || surface.draw->texture->environment != TextureEnvironment::modulate) return {right};
    const auto shifted = [](float v) { return std::floor(v * 255 * 255 / 256) / 255; };
    return {{shifted(right.r), shifted(right.g), shifted(right.b), right.a}};
  };
  const C found = learned(pipeline::make_pipeline(stages));
  ASSERT_EQ(found.unexplained.size(), 1u);
  EXPECT_NE(found.unexplained[0].find("fragment_colors: 256 texels times a colour"), std::string::npos)
      << found.unexplained[0];
}

TEST(LearnFog, AnotherDistanceIsAFinding) {
  pipeline::Stages stages = pipeline::production_stages();
  stages.shade = shade_by_half;
  const C found = learned(pipeline::make_pipeline(stages));
  ASSERT_EQ(found.unexplained.size(), 1u);
  EXPECT_NE(found.unexplained[0].find("of 64 pixels at most are explained"), std::string::npos) << found.unexplained[0];
}

TEST(LearnFog, IsOpenWithoutFog) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    if (std::ranges::any_of(scene.draws, [](const Draw& d) { return d.fog.has_value(); })) throw Unsupported("fog");
  };
  C expected = ours();
  expected.open = {"fog_factor", "fog_distance"};
  EXPECT_EQ(learn(renderer).conventions, expected);
}

}  // namespace
}  // namespace plumbline::learn

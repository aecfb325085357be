// Fog factors, and the numbers of fragments' colours, that plumb learn finds.
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/learn/altered_renderers.h"
#include "tests/learn/other_colors.h"

namespace plumbline::learn {
namespace {

// Stage shade by the distance from the eye in place of |z_eye|.
pipeline::Shaded shade_by_distance(const pipeline::Surface& surface, bool front,
                                   const pipeline::SurfaceAttributes<float>& attributes) {
  pipeline::SurfaceAttributes<float> other = attributes;
  pipeline::Color<float>& p = other[Varying::position];
  p.b = std::sqrt(p.r * p.r + p.g * p.g + p.b * p.b);
  return {pipeline::shade<float>(surface, front, other)};
}

TEST(LearnFog, FactorsOfVerticesAreFound) {
  C expected = ours();
  EXPECT_EQ(learned(pipeline::make_pipeline()), expected);
  expected.fog_factor = C::FogFactor::per_vertex;
  EXPECT_EQ(learned(test::make_fog_by_vertices<pipeline::fog_factor<float>>()), expected);
}

TEST(LearnFragmentColors, CodesAreFound) {
  C expected = ours();
  expected.fragment_colors = C::FragmentColors::in_codes;
  EXPECT_EQ(learned(pipeline::make_pipeline(test::stages_in_codes())), expected);
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
  stages.shade = shade_by_distance;
  const C found = learned(pipeline::make_pipeline(stages));
  ASSERT_EQ(found.unexplained.size(), 1u);
  EXPECT_NE(found.unexplained[0].find("64 by the distance from the eye, for |z_eye|"), std::string::npos)
      << found.unexplained[0];
}

TEST(LearnFog, IsOpenWithoutFog) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    if (std::ranges::any_of(scene.draws, [](const Draw& d) { return d.fog.has_value(); })) throw Unsupported("fog");
  };
  C expected = ours();
  expected.open = {"fog_factor"};
  EXPECT_EQ(learn(renderer).conventions, expected);
}

}  // namespace
}  // namespace plumbline::learn

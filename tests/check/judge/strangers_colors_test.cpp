// Renderers of others whose fog factors are those of vertices (OpenGL 2.1, 3.10), or whose fragments' colours are
// codes, judged by their frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "capture/by_conventions.h"
#include "tests/check/judge/frame_verdict.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/learn/other_colors.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

using C = Conventions;
using test::is_right;
using test::is_wrong;
using test::verdict_of;

C with_factors(C::FogFactor declared) {
  C out;
  out.fog_factor = declared;
  return out;
}
SceneVerdict verdict_of(const std::string& scene, std::unique_ptr<Renderer> renderer, C::FogFactor declared) {
  return verdict_of(scene, std::move(renderer), with_factors(declared));
}

// A frame of red, green and blue: its alpha is 1 to blending, and what stands in its place is not judged.
TEST(StrangersAlpha, MayBeNoneWhereThatIsDeclared) {
  C none;
  none.alpha = C::Alpha::none;
  const auto drawn = [](const std::string& name, float blue, float alpha) {
    auto out = std::make_unique<Changed>(pipeline::make_pipeline());
    out->on_capture = [=](Capture& c) {
      for (glm::vec4& color : c.planes.color.values()) color.b += blue, color.a = alpha;
    };
    return std::pair(suite_scene(name), std::move(out));
  };
  const auto verdict = [&](auto drawing, const C& declared) {
    return verdict_of(drawing.first, std::move(drawing.second), declared);
  };
  for (const char* name : {"light/color_material_flat", "light/all_at_once"}) {
    EXPECT_TRUE(is_right(verdict(drawn(name, 0, 1), none))) << name;
    EXPECT_TRUE(is_wrong(verdict(drawn(name, 0, 1), C()))) << name;
    EXPECT_TRUE(is_wrong(verdict(drawn(name, 2.0f / 255, 1), none))) << name;
  }
}

TEST(StrangersAlpha, IsOneToBlendingWhereThereIsNone) {
  Scene scene = suite_scene("first_triangles/draw_order");
  scene.draws[1].merge.blend = Blend{{BlendFactor::destination_alpha, BlendFactor::zero, BlendEquation::add},
                                     {BlendFactor::zero, BlendFactor::one, BlendEquation::add},
                                     glm::vec4(0)};
  C none;
  none.alpha = C::Alpha::none;
  const Scene blends = scene;
  scene.frame.clear_color.a = 0.5f;
  EXPECT_FALSE(is_opaque(scene));
  EXPECT_FALSE(is_opaque(blends));
  EXPECT_TRUE(is_opaque(suite_scene("first_triangles/draw_order")));
  Scene board = suite_scene("texture/board_nearest");
  ASSERT_TRUE(is_opaque(board));
  board.draws[0].texture->environment = TextureEnvironment::blend;
  board.draws[0].texture->color = {0.9f, 0.1f, 0.6f, 0.3f};
  EXPECT_FALSE(is_opaque(board)) << "an intensity blends alpha, too";
  const SceneByConventions seen(scene, none);
  EXPECT_EQ(seen->frame.clear_color.a, 1);
  for (const Draw& draw : seen->draws) EXPECT_FALSE(draw.merge.color_mask.a);
}

TEST(StrangersFog, FactorsMayBeThoseOfVerticesWhereThatIsDeclared) {
  using enum C::FogFactor;
  const auto by_vertices = [] { return test::make_fog_by_vertices<pipeline::fog_factor<float>>(); };
  for (const char* scene : {"fog/exp", "fog/exp2", "fog/cut", "fog/linear", "texture/floor_in_fog"}) {
    const SceneVerdict verdict = verdict_of(scene, by_vertices(), per_vertex);
    EXPECT_TRUE(is_right(verdict)) << scene;
    EXPECT_TRUE(is_wrong(verdict_of(scene, by_vertices(), per_fragment))) << scene;
  }
  EXPECT_TRUE(is_wrong(verdict_of("fog/exp", pipeline::make_pipeline(), per_vertex)));
}

TEST(StrangersFog, MayBeOfTheDistanceFromTheEyeWhereThatIsDeclared) {
  using enum C::FogDistance;
  const auto verdict = [](const char* scene, std::unique_ptr<Renderer> renderer, C::FogFactor factor,
                          C::FogDistance distance) {
    C declared = with_factors(factor);
    declared.fog_distance = distance;
    return verdict_of(scene, std::move(renderer), declared);
  };
  using enum C::FogFactor;
  const auto by_vertices = [] { return test::make_fog_by_vertices<pipeline::fog_factor<float>, test::length_of>(); };
  for (const char* scene : {"fog/exp", "fog/exp2", "fog/cut", "fog/linear", "fog/backwards", "texture/floor_in_fog"}) {
    EXPECT_TRUE(is_right(verdict(scene, test::make_radial_fog(), per_fragment, eye_radial))) << scene;
    EXPECT_TRUE(is_wrong(verdict(scene, test::make_radial_fog(), per_fragment, eye_plane))) << scene;
    EXPECT_TRUE(is_right(verdict(scene, by_vertices(), per_vertex, eye_radial))) << scene;
    EXPECT_TRUE(is_wrong(verdict(scene, by_vertices(), per_vertex, eye_plane))) << scene;
  }
  EXPECT_TRUE(is_wrong(verdict("fog/exp", pipeline::make_pipeline(), per_fragment, eye_radial)));
  EXPECT_TRUE(is_wrong(verdict("fog/exp", by_vertices(), per_fragment, eye_radial)));
}

// Factors of a cut polygon's corners lie between those of the mesh's vertices and those of fragments.
TEST(StrangersFog, FactorsOfCutTrianglesMayBeThoseOfTheCutCorners) {
  using enum C::FogFactor;
  constexpr auto halved = [](const Fog& fog, float z_eye) { return pipeline::fog_factor<float>(fog, z_eye) / 2; };
  for (const char* scene : {"fog/cut", "texture/floor_in_fog"}) {
    EXPECT_TRUE(is_right(verdict_of(scene, pipeline::make_pipeline(), per_vertex))) << scene << ", of tiny pieces";
    EXPECT_TRUE(is_wrong(verdict_of(scene, test::make_fog_by_vertices<halved>(), per_vertex))) << scene;
  }
}

// A floor whose corners lie at two distances, the nearer of them behind the eye: pieces that end at the near plane
// interpolate factors from there to the far edge.
TEST(StrangersFog, FactorsOfCutTrianglesMayBeInterpolatedFromTheNearPlane) {
  static constexpr float kNear = 0.1f, kFar = 38.455f;
  constexpr auto from_near = [](const Fog& fog, float z_eye) {
    const float share = (-z_eye - kNear) / (kFar - kNear);
    return glm::mix(pipeline::fog_factor<float>(fog, -kNear), pipeline::fog_factor<float>(fog, -kFar), share);
  };
  constexpr auto from_eye = [](const Fog& fog, float z_eye) {
    return glm::mix(1.0f, pipeline::fog_factor<float>(fog, -kFar), -z_eye / kFar);
  };
  Scene scene = suite_scene("texture/floor_in_fog");
  scene.camera.eye = {0, 0.7, 1}, scene.camera.center = {0, -0.15, -1.1};
  const auto drawn = [&](decltype(pipeline::Stages::shade) shade) {
    pipeline::Stages stages = pipeline::production_stages();
    stages.shade = shade;
    return verdict_of(scene, pipeline::make_pipeline(stages), with_factors(C::FogFactor::per_vertex));
  };
  EXPECT_TRUE(is_right(drawn(test::shade_with_fog_factors<from_near>)));
  EXPECT_TRUE(is_wrong(drawn(test::shade_with_fog_factors<from_eye>)));
}

// A piece from the near plane to where the fog is full, by a side of the window: its factors pass over the start.
TEST(StrangersFog, LinearFactorsOfCutTrianglesMayPassOverTheStart) {
  constexpr auto to_the_end = [](const Fog& fog, float z_eye) { return std::max(0.0f, 1 + z_eye / fog.end); };
  Scene scene = suite_scene("texture/floor_in_fog");
  scene.camera.eye = {0, 0.7, 1}, scene.camera.center = {0, -0.15, -1.1};
  scene.draws[0].fog = Fog{.mode = Fog::Mode::linear, .color = glm::vec3(0.3f, 0.4f, 0.5f), .start = 10, .end = 20};
  const auto verdict = [&](float start) {
    scene.draws[0].fog->start = start;
    pipeline::Stages stages = pipeline::production_stages();
    stages.shade = test::shade_with_fog_factors<to_the_end>;
    return verdict_of(scene, pipeline::make_pipeline(stages), with_factors(C::FogFactor::per_vertex));
  };
  EXPECT_TRUE(is_right(verdict(10)));
  EXPECT_TRUE(is_wrong(verdict(-10))) << "before the near plane";
}

TEST(StrangersFog, LinearFactorsMayBeClampedBeforeOrAfterTheyAreInterpolated) {
  using enum C::FogFactor;
  EXPECT_TRUE(is_right(verdict_of("fog/linear", test::make_fog_by_vertices<test::unclamped_fog_factor>(), per_vertex)));
  EXPECT_TRUE(is_right(verdict_of("fog/linear", pipeline::make_pipeline(), per_vertex))) << "which is the same";
  constexpr auto halved = [](const Fog& fog, float z_eye) { return pipeline::fog_factor<float>(fog, z_eye) / 2; };
  EXPECT_TRUE(is_wrong(verdict_of("fog/linear", test::make_fog_by_vertices<halved>(), per_vertex)));
}

// Colours without perspective under a texture with it.
TEST(StrangersColors, AloneMayBeAffineWhereThatIsDeclared) {
  C colors, all, others;
  colors.color_interpolation = C::ColorInterpolation::affine, all.interpolation = C::Interpolation::affine;
  others.interpolation = C::Interpolation::affine, others.color_interpolation = C::ColorInterpolation::perspective;
  Scene scene = test::narrow_floor();
  scene.draws[0].texture->environment = TextureEnvironment::modulate;
  scene.meshes[0].colors = {{1, 0.2f, 0.2f, 1}, {1, 0.2f, 0.2f, 1}, {0.2f, 1, 1, 1}, {0.2f, 1, 1, 1}};
  EXPECT_TRUE(is_right(verdict_of(scene, test::make_affine_colors(), colors)));
  EXPECT_TRUE(is_wrong(verdict_of(scene, test::make_affine_colors(), C())));
  EXPECT_TRUE(is_wrong(verdict_of(scene, test::make_affine_colors(), all)));
  EXPECT_TRUE(is_wrong(verdict_of(scene, pipeline::make_pipeline(), colors)));
  EXPECT_TRUE(is_right(verdict_of(scene, test::make_affine_colors<false>(), others)));
  EXPECT_TRUE(is_wrong(verdict_of(scene, test::make_affine_colors<false>(), all)));
  EXPECT_TRUE(is_wrong(verdict_of(scene, test::make_affine_colors(), others)));
}

TEST(StrangersColors, OfVerticesMayBeCodesWhereThatIsDeclared) {
  C in_codes;
  in_codes.vertex_colors = C::ColorNumbers::in_codes;
  for (const char* scene : {"interpolation/ramps", "light/sphere_gouraud", "texture/vertex_colors_flat"}) {
    EXPECT_TRUE(is_right(verdict_of(scene, test::make_vertices_in_codes(), in_codes))) << scene;
    EXPECT_TRUE(is_wrong(verdict_of(scene, test::make_vertices_in_codes(), C()))) << scene;
    EXPECT_TRUE(is_wrong(verdict_of(scene, test::make_vertices_in_codes<2>(), in_codes))) << scene;
    EXPECT_TRUE(is_right(verdict_of(scene, pipeline::make_pipeline(), in_codes))) << scene;
  }
}

TEST(StrangersColors, MayBeCodesBeforeTheyAreMergedWhereThatIsDeclared) {
  C in_float, in_codes;
  in_codes.fragment_colors = C::ColorNumbers::in_codes;
  const auto by_codes = [] { return pipeline::make_pipeline(test::stages_in_codes()); };
  for (const char* scene : {"texture/floor_modulated", "texture/vertex_colors_flat", "fog/exp", "blend/halves"}) {
    const SceneVerdict verdict = verdict_of(scene, by_codes(), in_codes);
    EXPECT_TRUE(is_right(verdict)) << scene;
  }
  for (const char* scene : {"texture/floor_modulated", "texture/vertex_colors_flat"})
    EXPECT_TRUE(is_wrong(verdict_of(scene, by_codes(), in_float))) << scene;
}

// Alphas of codes, compared as floats: bands where a code is equal to the reference are a code wide.
TEST(StrangersColors, InCodesHaveAlphasInCodesWhateverTheyAreComparedAs) {
  C conventions;
  conventions.alpha_test = C::AlphaTest::in_float;
  const auto drawn = [&] {
    return verdict_of("alpha_test/bands", pipeline::make_pipeline(test::stages_in_codes()), conventions);
  };
  EXPECT_TRUE(is_wrong(drawn()));
  conventions.fragment_colors = C::ColorNumbers::in_codes;
  EXPECT_TRUE(is_right(drawn()));
}

TEST(StrangersColors, ShadedPlanesMayBeCodesToo) {
  C in_float, in_codes;
  in_codes.fragment_colors = C::ColorNumbers::in_codes;
  const auto verdict = [](const C& conventions) {
    return verdict_of(suite_scene("interpolation/ramps"), pipeline::make_pipeline(test::stages_in_codes()), conventions,
                      true);
  };
  const auto outcome = [&](const C& conventions) {
    for (const Comparison& c : verdict(conventions).comparisons) {
      if (c.stage == Stage::attributes && was_compared(c)) return c.outcome;
    }
    return Outcome::unsupported;
  };
  EXPECT_TRUE(holds(outcome(in_codes)));
  EXPECT_TRUE(is_right(verdict(in_codes)));
  EXPECT_EQ(outcome(in_float), Outcome::different);
}

// A colour that no texture or fog changes is rounded once: truncated colours are wrong.
TEST(StrangersColors, InCodesAreRoundedOnceWhereNoOtherStepIs) {
  pipeline::Stages stages = pipeline::production_stages();
  stages.merge = [](const pipeline::Color<float>& color, float scale) -> pipeline::Color<float> {
    const auto down = [=](float v) { return std::floor(std::clamp(v, 0.0f, 1.0f) * scale); };
    return {down(color.r), down(color.g), down(color.b), down(color.a)};
  };
  C in_codes;
  in_codes.fragment_colors = C::ColorNumbers::in_codes;
  EXPECT_TRUE(is_wrong(verdict_of("interpolation/ramps", pipeline::make_pipeline(stages), in_codes)));
  EXPECT_TRUE(is_right(verdict_of("interpolation/ramps", pipeline::make_pipeline(), in_codes)));
}

// Stage shade whose colours are off by that many tenths of a code.
template <int tenths>
pipeline::Shaded shade_off(const pipeline::Surface& surface, bool front,
                           const pipeline::SurfaceAttributes<float>& attributes) {
  pipeline::Color<float> color = pipeline::shade<float>(surface, front, attributes);
  constexpr float kOff = tenths / 2550.0f;
  return {{color.r + kOff, color.g + kOff, color.b + kOff, color.a}};
}

TEST(StrangersColors, InCodesAreOffToTheSideOfTheirRounding) {
  const auto drawn = [](decltype(pipeline::Stages::shade) shade, C::Rounding rounding) {
    pipeline::Stages stages = pipeline::production_stages();
    stages.shade = shade;
    C in_codes;
    in_codes.fragment_colors = C::ColorNumbers::in_codes;
    in_codes.color_rounding = rounding;
    return verdict_of("texture/floor_modulated", pipeline::make_pipeline(stages), in_codes);
  };
  using enum C::Rounding;
  EXPECT_TRUE(is_wrong(drawn(shade_off<21>, nearest)));
  EXPECT_TRUE(is_wrong(drawn(shade_off<-21>, nearest)));
  EXPECT_TRUE(is_wrong(drawn(shade_off<5>, down)));
  EXPECT_TRUE(is_right(drawn(shade_off<-10>, down)));
  EXPECT_TRUE(is_wrong(drawn(shade_off<-40>, down)));
  EXPECT_TRUE(is_wrong(drawn(shade_off<-21>, up)));
}

}  // namespace
}  // namespace plumbline::check

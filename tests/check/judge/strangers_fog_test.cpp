// Renderers of others whose fog factors are those of vertices (OpenGL 2.1, 3.10), judged by their frames.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "capture/renderers/replayed_renderer.h"
#include "check/judge/judge_single.h"
#include "reference/exact/exact.h"
#include "tests/check/suite_scenes.h"
#include "tests/learn/fog_by_vertices.h"

namespace plumbline::check {
namespace {

using C = Conventions;

// Verdict on the renderer's colours and depths.
SceneVerdict verdict_of(const std::string& scene_name, std::unique_ptr<Renderer> renderer, C::FogFactor declared) {
  const Scene scene = suite_scene(scene_name);
  const auto exact = exact::make_exact();
  const Reference references[] = {{"exact", exact.get()}};
  const Planes drawn = renderer->capture(scene, Request{}).planes;
  Capture frame;
  frame.width = scene.frame.width, frame.height = scene.frame.height;
  frame.planes.color = drawn.color, frame.planes.depth = drawn.depth;
  C conventions;
  conventions.fog_factor = declared;
  const auto replayed = make_replayed_renderer(std::move(frame), scene, "test", conventions);
  return judge_single(scene, *replayed, references);
}
bool is_right(const SceneVerdict& verdict) {
  return std::ranges::none_of(verdict.comparisons, [](const Comparison& c) { return c.outcome == Outcome::different; });
}
bool judges_colors(const SceneVerdict& verdict) {
  return std::ranges::any_of(verdict.comparisons,
                             [](const Comparison& c) { return c.stage == Stage::merge && was_compared(c); });
}

TEST(StrangersFog, FactorsMayBeThoseOfVerticesWhereThatIsDeclared) {
  using enum C::FogFactor;
  const auto by_vertices = [] { return test::make_fog_by_vertices<pipeline::fog_factor<float>>(); };
  for (const char* scene : {"fog/exp", "fog/exp2", "fog/cut", "fog/linear", "texture/floor_in_fog"}) {
    const SceneVerdict verdict = verdict_of(scene, by_vertices(), per_vertex);
    EXPECT_TRUE(is_right(verdict)) << scene;
    EXPECT_TRUE(judges_colors(verdict)) << scene;
    EXPECT_FALSE(is_right(verdict_of(scene, by_vertices(), per_fragment))) << scene;
  }
  for (const char* scene : {"fog/exp", "fog/cut", "texture/floor_in_fog"})
    EXPECT_FALSE(is_right(verdict_of(scene, pipeline::make_pipeline(), per_vertex))) << scene;
}

TEST(StrangersFog, LinearFactorsMayBeClampedBeforeOrAfterTheyAreInterpolated) {
  using enum C::FogFactor;
  EXPECT_TRUE(is_right(verdict_of("fog/linear", test::make_fog_by_vertices<test::unclamped_fog_factor>(), per_vertex)));
  EXPECT_TRUE(is_right(verdict_of("fog/linear", pipeline::make_pipeline(), per_vertex))) << "which is the same";
  constexpr auto halved = [](const Fog& fog, float z_eye) { return pipeline::fog_factor<float>(fog, z_eye) / 2; };
  EXPECT_FALSE(is_right(verdict_of("fog/linear", test::make_fog_by_vertices<halved>(), per_vertex)));
}

}  // namespace
}  // namespace plumbline::check

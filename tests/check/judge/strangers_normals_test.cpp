// Normals of a stranger: of any length where the draw has them normalized. Varyings and planes that a stranger does not
// show.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>

#include "capture/renderers/replayed_renderer.h"
#include "check/judge/judge_single.h"
#include "check/judge/stage_inputs.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "tests/check/fixtures.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

// The outcome of a stage's row where a stranger's capture is changed.
Outcome outcome_of(const std::string& scene_name, Stage stage, const std::function<void(Capture&)>& change) {
  const Scene scene = suite_scene(scene_name);
  const auto exact = exact::make_exact();
  const Reference references[] = {{"exact", exact.get()}};
  OursAsAnothers other(change);
  for (const Comparison& c : judge_single(scene, other, references).comparisons) {
    if (c.stage == stage && c.judge.kind == Kind::per_stage) return c.outcome;
  }
  return Outcome::unsupported;
}

// The outcome where its n_eye are changed.
Outcome outcome_of(const std::string& scene_name, Stage stage, const std::function<void(Vec3<double>&)>& change) {
  return outcome_of(scene_name, stage, [&](Capture& capture) {
    for (Vertex<double>& v : capture.records.vertices) change(v.n_eye);
  });
}

TEST(StrangersNormals, MayBeNormalizedAsTheyAreInterpolated) {
  const auto outcome = [](double length, bool turned) {
    return outcome_of("phong/squashed", Stage::attributes, [=](Capture& capture) {
      for (Vec4<double>& n : capture.records.varyings[Varying::normal].fragments) {
        n *= length / glm::length(Vec3<double>(n));
        if (turned) std::swap(n.x, n.y);
      }
    });
  };
  EXPECT_NE(outcome(1, false), Outcome::different);
  EXPECT_EQ(outcome(1, true), Outcome::different);
  EXPECT_EQ(outcome(2, false), Outcome::different);
  EXPECT_EQ(outcome(0, false), Outcome::different);
}

TEST(StrangersNormals, MayHaveAnyLengthWhereTheyAreNormalized) {
  for (const Stage stage : {Stage::vertex, Stage::light}) {
    const auto outcome = [&](double by) {
      return outcome_of("light/highlight_half_vector", stage, [=](Vec3<double>& n) { n *= by; });
    };
    EXPECT_NE(outcome(1), Outcome::different) << name_of(stage);
    EXPECT_EQ(outcome(3), outcome(1)) << name_of(stage);
    EXPECT_EQ(outcome(-3), Outcome::different) << name_of(stage) << ", the other way";
    if (stage == Stage::light) continue;  // where normals are no directions, no colour is known
    EXPECT_EQ(outcome(0), Outcome::different);
    EXPECT_EQ(outcome(std::numeric_limits<double>::quiet_NaN()), Outcome::different);
  }
}

TEST(StrangersNormals, MayHaveAnyLengthWhereFragmentsAreLit) {
  const auto outcome = [](double by) {
    return outcome_of("phong/squashed", Stage::vertex, [=](Vec3<double>& n) { n *= by; });
  };
  EXPECT_EQ(outcome(1), Outcome::within);
  EXPECT_EQ(outcome(3), Outcome::within);
  EXPECT_EQ(outcome(-3), Outcome::different);
}

TEST(StrangersVaryings, ThatAreLackingAreNamed) {
  const Scene scene = suite_scene("light/two_sided_culled");
  const auto exact = exact::make_exact();
  const Reference references[] = {{"exact", exact.get()}};
  OursAsAnothers other([](Capture& capture) { capture.records.varyings[Varying::back_color].vertices.clear(); });
  const SceneVerdict verdict = judge_single(scene, other, references);
  for (const Stage stage : {Stage::light, Stage::clip}) {  // which hands it on, and which reads it
    const auto row = std::ranges::find_if(
        verdict.comparisons, [&](const Comparison& c) { return c.stage == stage && c.judge.kind == Kind::per_stage; });
    ASSERT_NE(row, verdict.comparisons.end());
    EXPECT_EQ(row->outcome, Outcome::unsupported);
    EXPECT_EQ(row->note, "it shows no varyings.back_color.vertices");
  }
}

TEST(StrangersNormals, HaveTheirLengthWhereTheyAreNot) {
  const auto outcome = [](double by) {
    return outcome_of("light/normals_grown", Stage::vertex, [=](Vec3<double>& n) { n *= by; });
  };
  EXPECT_EQ(outcome(1), Outcome::within);
  EXPECT_EQ(outcome(3), Outcome::different);
}

// Winners are compared without the stencil values that a stranger does not show.
TEST(StrangersPlanes, OfStencilValuesMayLack) {
  const auto outcome = [](bool shows_stencil, bool is_wrong) {
    return outcome_of("stencil/ops", Stage::visibility, [=](Capture& capture) {
      if (!shows_stencil) capture.planes.stencil = {};
      if (shows_stencil && is_wrong) ++capture.planes.stencil(0, 0);
      if (!shows_stencil && is_wrong) capture.planes.id(0, 0) = 1 - std::max(capture.planes.id(0, 0), 0);
    });
  };
  EXPECT_NE(outcome(true, false), Outcome::different);
  EXPECT_EQ(outcome(true, true), Outcome::different);
  EXPECT_NE(outcome(false, false), Outcome::different);
  EXPECT_EQ(outcome(false, true), Outcome::different);
}

TEST(StrangersPlanes, OfStencilValuesAreNotReadWhereTheFrameHasNone) {
  const Scene scene = suite_scene("fog/linear");
  Capture capture = exact_capture(scene);
  capture.planes.stencil = Plane<std::uint8_t>(capture.width, capture.height, 0);
  const auto renderer = make_replayed_renderer(std::move(capture), scene, "test");
  EXPECT_TRUE(renderer->capture(scene, {}).planes.stencil.empty());
  EXPECT_TRUE(renderer->info()[Stage::visibility].shows);
}

// A row beside another renderer's plane needs the candidate's plane.
TEST(StrangersPlanes, ThatLackAreNotComparedBesideAnothers) {
  const Scene scene = suite_scene("fog/linear");
  Planes planes = exact_capture(scene).planes;
  const RendererInfo info = pipeline::make_pipeline()->info();
  EXPECT_EQ(lacking_beside(scene, planes, info, Stage::shade), "");
  planes.shaded = {};
  EXPECT_EQ(lacking_beside(scene, planes, info, Stage::shade), "it shows no planes.shaded");
  EXPECT_EQ(lacking_beside(scene, planes, info, Stage::depth), "");
  planes.depth = {};
  EXPECT_EQ(lacking_beside(scene, planes, info, Stage::depth), "it shows no planes.depth");
}

}  // namespace
}  // namespace plumbline::check

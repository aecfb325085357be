// Normals of a stranger: of any length where the draw has them normalized.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "check/judge/judge_single.h"
#include "reference/exact/exact.h"
#include "tests/check/judge/judge_fixtures.h"
#include "tests/check/suite_scenes.h"

namespace plumbline::check {
namespace {

// The outcome of a stage's row where a stranger's n_eye is changed.
Outcome outcome_of(const std::string& scene_name, Stage stage, const std::function<void(Vec3<double>&)>& change) {
  const Scene scene = suite_scene(scene_name);
  const auto exact = exact::make_exact();
  const Reference references[] = {{"exact", exact.get()}};
  OursAsAnothers other([&](Capture& capture) {
    for (Vertex<double>& v : capture.records.vertices) change(v.n_eye);
  });
  for (const Comparison& c : judge_single(scene, other, references).comparisons) {
    if (c.stage == stage && c.judge.kind == Kind::per_stage) return c.outcome;
  }
  return Outcome::unsupported;
}

TEST(StrangersNormals, MayHaveAnyLengthWhereTheyAreNormalized) {
  for (const Stage stage : {Stage::vertex, Stage::light}) {
    const auto outcome = [&](double by) {
      return outcome_of("light/highlight_half_vector", stage, [=](auto& n) { n *= by; });
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
  const auto outcome = [](double by) { return outcome_of("phong/squashed", Stage::vertex, [=](auto& n) { n *= by; }); };
  EXPECT_EQ(outcome(1), Outcome::within);
  EXPECT_EQ(outcome(3), Outcome::within);
  EXPECT_EQ(outcome(-3), Outcome::different);
}

TEST(StrangersNormals, HaveTheirLengthWhereTheyAreNot) {
  const auto outcome = [](double by) {
    return outcome_of("light/normals_grown", Stage::vertex, [=](auto& n) { n *= by; });
  };
  EXPECT_EQ(outcome(1), Outcome::within);
  EXPECT_EQ(outcome(3), Outcome::different);
}

}  // namespace
}  // namespace plumbline::check

// Lights in eye space: their comparator, and who is named where they are wrong.
#include "check/compare/compare_records.h"
#include "check/judge/judge_records.h"
#include "check/judge/stage_copy.h"
#include "reference/arithmetic/light_bounds.h"
#include "tests/check/judge/judge_fixtures.h"

namespace plumbline::check {
namespace {

// A light of each kind, before a camera that is turned.
struct LightRecords : testing::Test {
  LightRecords() {
    scene.camera = {{3, 2, 5}, {0, 0.5, 0}, {0, 1, 0}};
    Light lamp;
    lamp.kind = Light::Kind::point;
    lamp.vector = {1.5, 3, 4};
    lamp.spot = Spot{{-0.4, -0.8, -1}, 60, 2};
    lamp.diffuse = scene.lights[0].diffuse = glm::vec3(0.5f);  // their sum stays below 1
    lamp.specular = glm::vec3(0);
    scene.lights.push_back(lamp);
    reference = exact_capture(scene).records;
    mine = exact_capture(scene);
    round_to_formats(scene, Stage::matrices, mine);
  }
  Measurement compared(const Records<double>& candidate) const {
    return compare_lights(scene, candidate, reference, 1);
  }
  static std::vector<double*> entries(LightSource<double>& l) {
    return {&l.p_eye.x, &l.p_eye.y, &l.p_eye.z, &l.p_eye.w, &l.spot_eye.x, &l.spot_eye.y, &l.spot_eye.z};
  }
  Scene scene = two_draws();
  Records<double> reference;
  Capture mine;
};

TEST_F(LightRecords, RoundedOncePass) {
  ASSERT_EQ(mine.records.lights.size(), 2u);
  EXPECT_NE(mine.records.lights[1].p_eye, reference.lights[1].p_eye);
  EXPECT_TRUE(passes(compared(mine.records)));
  EXPECT_EQ(compared(mine.records).items, 2u);
  EXPECT_TRUE(passes(compared(reference)));
}

TEST_F(LightRecords, OneUlpOfAnyEntryFails) {
  for (std::size_t light = 0; light < 2; ++light) {
    for (std::size_t i = 0; i < 7; ++i) {
      Records<double> other = mine.records;
      double& entry = *entries(other.lights[light])[i];
      entry = entry == 0 ? 1e-9 : float_above(float_above(entry));  // one from the nearest, or more
      EXPECT_TRUE(fails(compared(other))) << light << " " << i;
      EXPECT_EQ(compared(other).worst.place.record, static_cast<std::int64_t>(light));
      EXPECT_STREQ(compared(other).worst.place.field, i < 4 ? "light p_eye" : "light spot_eye");
    }
  }
}

// The error of double in a place is in proportion to the light's and the eye's distances.
TEST_F(LightRecords, EntriesThatCancelPassWithinTheErrorOfDouble) {
  Records<double> at_0 = reference;
  at_0.lights[1].p_eye = {0, 1, 0, 1};
  reference = at_0;
  const double v = glm::length(scene.lights[1].vector), columns = 2 * v + 1 + v;
  at_0.lights[1].p_eye.x = 0.99e-12 * columns;
  EXPECT_TRUE(passes(compared(at_0)));
  at_0.lights[1].p_eye.x = 1.01e-12 * columns;
  EXPECT_TRUE(fails(compared(at_0)));
  at_0 = reference;
  reference.lights[0].p_eye = at_0.lights[0].p_eye = {0, 0, 1, 0};
  const double direction = glm::length(scene.lights[0].vector);
  at_0.lights[0].p_eye.x = 1.99e-12 * direction;
  EXPECT_TRUE(passes(compared(at_0)));
  at_0.lights[0].p_eye.x = 2.01e-12 * direction;
  EXPECT_TRUE(fails(compared(at_0)));
}

TEST_F(LightRecords, WhatIsNoNumberFails) {
  for (const double bad : not_numbers()) {
    for (std::size_t i = 0; i < 7; ++i) {
      Records<double> other = mine.records;
      *entries(other.lights[1])[i] = bad;
      EXPECT_TRUE(fails(compared(other))) << i;
      EXPECT_TRUE(fails(compare_lights(scene, reference, other, 1))) << i;
      if (std::isnan(bad)) {
        EXPECT_TRUE(fails(compare_lights(scene, other, other, 1))) << i;
      }
    }
  }
}

TEST_F(LightRecords, AMissingLightFailsAndNoneRecordedPasses) {
  Records<double> other = mine.records;
  other.lights.pop_back();
  EXPECT_TRUE(fails(compared(other)));
  EXPECT_NE(compared(other).mismatch, "");
  other = mine.records;
  other.lights.emplace_back();
  EXPECT_TRUE(fails(compared(other), 3));
  other.lights.clear();
  EXPECT_TRUE(passes(compared(other)));
  EXPECT_EQ(compared(other).items, 0u);
  Records<double> none = reference;
  none.lights.clear();
  EXPECT_TRUE(fails(compare_lights(scene, mine.records, none, 1), 2));
}

// Rows of stages judged alone, which do not see matrices.
TEST_F(LightRecords, ALightInTheWrongPlaceIsTheFaultOfMatrices) {
  for (const bool phong : {false, true}) {
    SCOPED_TRACE(phong);
    if (phong) scene.draws[0].shading = Shading::phong;
    Capture wrong;
    wrong.width = scene.frame.width;
    wrong.height = scene.frame.height;
    const auto exact = exact::make_exact();
    for (std::size_t i = 0; i <= static_cast<std::size_t>(Stage::merge); ++i) {
      const auto stage = static_cast<Stage>(i);
      if (stage == Stage::texture) continue;
      copy_stage(stage, exact->run_stage(scene, stage, wrong), wrong);
      round_to_formats(scene, stage, wrong);
      if (stage != Stage::matrices) continue;
      ASSERT_EQ(wrong.records.lights.size(), 2u);
      wrong.records.lights[1].p_eye.x += 0.5;
    }
    for (const Comparison& c : judge_records(scene, wrong, *exact)) {
      EXPECT_NE(c.outcome, Outcome::different) << name_of(c.stage);
      EXPECT_NE(c.outcome, Outcome::failed) << name_of(c.stage) << " " << c.note;
    }
    // Made of the scene's lights, the colours are others.
    wrong.records.lights.clear();
    std::vector<Stage> different;
    for (const Comparison& c : judge_records(scene, wrong, *exact)) {
      if (c.outcome == Outcome::different) different.push_back(c.stage);
    }
    EXPECT_EQ(different, std::vector{phong ? Stage::shade : Stage::light});
  }
}

// A light near the vertex has the larger bound.
TEST_F(LightRecords, TheBoundOfLightIsOfTheRecordedLights) {
  const Vertex<double> vertex{{0, 0, -5, 1}, {}, {0, 0, 1}};
  const auto bound = [&](std::span<const LightSource<double>> lights) {
    const math::DoubleMaterial material = math::material_at(scene, scene.draws[0], {}, 0);
    return math::light_bounds(scene, material, vertex, {}, lights).magnitude.r;
  };
  EXPECT_NEAR(bound(reference.lights) / bound({}), 1, 1e-9);
  std::vector<LightSource<double>> near = reference.lights;
  near[1] = {{0, 0, -4.99, 1}, {0, 0, -1}};
  EXPECT_GT(bound(near), 10 * bound({}));
}

TEST_F(LightRecords, AnotherNumberOfLightsIsRefused) {
  mine.records.lights.pop_back();
  for (const Stage stage : {Stage::light, Stage::shade}) {
    scene.draws[0].shading = stage == Stage::light ? Shading::gouraud : Shading::phong;
    EXPECT_THROW(exact::make_exact()->run_stage(scene, stage, mine), std::invalid_argument) << name_of(stage);
  }
}

}  // namespace
}  // namespace plumbline::check

// Captures of others that lack records or planes which a row can do without.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include "capture/renderers/replayed_renderer.h"
#include "check/judge/judge_single.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "tests/suite.h"

namespace plumbline::check {
namespace {

// The outcome of a stage's row by exact, per stage, of our capture where it is changed and then read as another's.
Outcome outcome_of(const Scene& scene, Stage stage, const std::function<void(Capture&)>& change,
                   const Conventions& conventions = undeclared()) {
  Capture capture = pipeline::make_pipeline()->capture(scene, {.records = StageSet::all()});
  change(capture);
  const auto replayed = make_replayed_renderer(std::move(capture), scene, "test", conventions);
  const auto exact = exact::make_exact();
  const Reference references[] = {{"exact", exact.get()}};
  for (const Comparison& c : judge_single(scene, *replayed, references).comparisons) {
    if (c.stage == stage && c.judge.kind == Kind::per_stage) return c.outcome;
  }
  return Outcome::unsupported;
}
bool is_held(Outcome outcome) { return outcome != Outcome::unsupported && holds(outcome); }

// Frames whose winners do not tell what lies beneath.
TEST(StrangersLacking, DrawnIsTestedAnewWhereWinnersDoNotTellTheFrame) {
  for (const char* name : {"blend/halves", "logic_op/cursor", "masks/no_depth", "stencil/ops", "coverage/fan"}) {
    const auto outcome = [&](float off) {
      return outcome_of(suite_scene(name), Stage::merge, [=](Capture& capture) {
        capture.records.drawn.clear();
        capture.planes.color(1, 1).x += off;
      });
    };
    EXPECT_TRUE(is_held(outcome(0))) << name;
    EXPECT_EQ(outcome(0.1f), Outcome::different) << name;
  }
}

// Tests by floats, and products that are rounded down, of a renderer that shows neither what is drawn nor how.
TEST(StrangersLacking, DrawnIsTestedAnewAsDeclared) {
  Conventions truncated;
  truncated.blending = Conventions::Blending::in_codes_down;
  const auto outcome = [&](float codes) {
    return outcome_of(
        suite_scene("blend/halves"), Stage::merge,
        [=](Capture& capture) {
          capture.records.drawn.clear();
          for (glm::vec4& color : capture.planes.color.values()) color.g = std::max(color.g - codes / 255, 0.0f);
        },
        truncated);
  };
  EXPECT_TRUE(is_held(outcome(0)));
  EXPECT_TRUE(is_held(outcome(1))) << "truncated";
  EXPECT_EQ(outcome(9), Outcome::different);
}

TEST(StrangersLacking, CountsAloneAreCompared) {
  const auto outcome = [](std::uint32_t more) {
    return outcome_of(suite_scene("coverage/fan"), Stage::coverage, [=](Capture& capture) {
      capture.records.covered.clear(), capture.records.depth.clear(), capture.records.attributes.clear();
      capture.records.shaded.clear(), capture.records.drawn.clear();
      capture.planes.id_sum = {};
      capture.planes.count(0, 0) += more;
    });
  };
  EXPECT_TRUE(is_held(outcome(0)));
  EXPECT_EQ(outcome(1), Outcome::different);
}

TEST(StrangersLacking, StencilValuesAloneAreCompared) {
  const auto outcome = [](std::uint8_t more) {
    return outcome_of(suite_scene("stencil/ops"), Stage::visibility, [=](Capture& capture) {
      capture.records.drawn.clear();
      capture.planes.id = {};
      capture.planes.stencil(0, 0) = static_cast<std::uint8_t>(capture.planes.stencil(0, 0) + more);
    });
  };
  EXPECT_TRUE(is_held(outcome(0)));
  EXPECT_EQ(outcome(1), Outcome::different);
}

TEST(StrangersLacking, ColorsAreNoInputOfVisibilityWithoutAlphaTests) {
  const auto outcome = [](const char* name) {
    return outcome_of(suite_scene(name), Stage::visibility, [](Capture& capture) { capture.records.shaded.clear(); });
  };
  EXPECT_TRUE(is_held(outcome("coverage/fan")));
  EXPECT_EQ(outcome("alpha_test/bands"), Outcome::unsupported);
}

TEST(StrangersLacking, NormalsAreThoseThatFragmentsAreInterpolatedFrom) {
  const auto outcome = [](double off) {
    return outcome_of(suite_scene("phong/beside_gouraud"), Stage::light, [=](Capture& capture) {
      for (Vertex<double>& v : capture.records.vertices) v.n_eye = {};
      for (Vec4<double>& n : capture.records.varyings[Varying::normal].vertices) n.x += off;
      capture.derived.insert("vertex.n_eye");
    });
  };
  EXPECT_TRUE(is_held(outcome(0)));
}

// A renderer that multiplies positions by one matrix knows no positions in eye space.
TEST(StrangersLacking, EyeSpaceIsNoInputOfClipping) {
  const auto outcome = [](const char* name, double off) {
    return outcome_of(suite_scene(name), Stage::clip, [=](Capture& capture) {
      capture.records.matrices.clear(), capture.records.lights.clear();
      capture.derived = {"vertex.p_eye", "vertex.n_eye"};
      for (Vertex<double>& v : capture.records.vertices) v.p_eye = {}, v.n_eye = {};
      capture.records.polygons.vertices[0].p_clip.x += off;
    });
  };
  for (const char* name : {"coverage/fan", "clip/crowd", "texture/floor_nearest"}) {
    EXPECT_TRUE(is_held(outcome(name, 0))) << name;
    EXPECT_EQ(outcome(name, 0.1), Outcome::different) << name;
  }
}

TEST(StrangersLacking, FragmentsDepthsInFloatAreCodes) {
  const auto outcome = [](double first_off) {
    return outcome_of(suite_scene("depth/grazing"), Stage::depth, [=](Capture& capture) {
      for (double& z : capture.records.depth) z = static_cast<float>(z);
      capture.records.depth[0] += first_off;
    });
  };
  EXPECT_TRUE(is_held(outcome(0)));
  EXPECT_EQ(outcome(0x1p-40), Outcome::different) << "one is no float: all are as they are";
}

// Fragments whose alpha is compared as a code, or as a float: 128.4 and 128.1 codes are one code.
TEST(StrangersLacking, AlphaTestsMayUseEitherArithmetic) {
  Scene scene = suite_scene("coverage/fan");
  for (Mesh& mesh : scene.meshes) {
    for (glm::vec4& color : mesh.colors) color.a = 128.4f / 255;
  }
  for (Draw& draw : scene.draws) {
    draw.material.diffuse.a = 128.4f / 255;
    draw.alpha_test = AlphaTest{CompareFunc::greater, 128.1f / 255};
  }
  Scene untested = scene;
  for (Draw& draw : untested.draws) draw.alpha_test.reset();
  const Capture by_floats = pipeline::make_pipeline()->capture(untested, {.records = StageSet::all()});
  const auto outcome = [&](Conventions::AlphaTest declared, bool one_off) {
    Conventions conventions;
    conventions.alpha_test = declared;
    return outcome_of(
        scene, Stage::visibility,
        [&](Capture& capture) {
          capture = by_floats;
          if (one_off) capture.records.drawn[0].drawn = !capture.records.drawn[0].drawn;
        },
        conventions);
  };
  using enum Conventions::AlphaTest;
  EXPECT_TRUE(is_held(outcome(either, false)));
  EXPECT_EQ(outcome(either, true), Outcome::different);
  EXPECT_TRUE(is_held(outcome(in_float, false)));
  EXPECT_EQ(outcome(in_codes, false), Outcome::different);
}

}  // namespace
}  // namespace plumbline::check

// Each stage of the pipeline run alone through the interface of all renderers.
#include <functional>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/capture_columns.h"
#include "renderers/pipeline_renderer.h"
#include "tests/capture/differing_arrays.h"
#include "tests/pipeline/boxes.h"
#include "tests/suite.h"

namespace plumbline::pipeline {
namespace {

using test::differing_planes;
using test::differing_records;
using testing::IsEmpty;
using testing_words::boxes;
using testing_words::everything;
using testing_words::kFormats;

/// Arrays of some stages in a capture, but for planes.texel and planes.shaded, which no stage run alone fills.
struct Chosen {
  std::function<bool(Stage)> has;
  void group(Handed group, const auto&, const auto& from, auto& to) const {
    if (has(group.stage)) to = from;
  }
  void plane(Handed plane, const auto& from, auto& to) const {
    if (has(plane.stage) && plane.stage != Stage::texture && plane.stage != Stage::shade) to = from;
  }
};
Capture of_stage(const Capture& whole, Stage stage) {
  Capture out;
  visit_capture(Chosen{[=](Stage s) { return s == stage; }}, whole, out);
  return out;
}
Capture records_before(const Capture& whole, Stage stage) {
  Capture out;
  visit_capture(Chosen{[=](Stage s) { return s < stage; }}, whole, out);
  out.planes = {};
  return out;
}

void expect_each_stage_alone(const Scene& scene) {
  const auto pipeline = make_pipeline();
  const Capture whole = pipeline->capture(scene, {.records = StageSet::all()});
  for (const Stage stage : stages_of(scene)) {
    SCOPED_TRACE(name_of(stage));
    const Capture alone = pipeline->run_stage(scene, stage, records_before(whole, stage));
    const Capture expected = of_stage(whole, stage);
    EXPECT_EQ(alone.renderer, "ours");
    EXPECT_EQ(alone.width, scene.frame.width);
    EXPECT_EQ(alone.height, scene.frame.height);
    EXPECT_THAT(differing_records(alone, expected), IsEmpty());
    EXPECT_THAT(differing_planes(alone, expected), IsEmpty());
  }
}

TEST(PipelineRenderer, EachStageAloneOnTheRecordsBeforeItIsTheWhole) {
  for (const auto& [color, depth] : kFormats) expect_each_stage_alone(boxes(color, depth));
  for (const char* file : {"phong/all_at_once", "phong/separate_on_texels", "light/two_sided_cut", "stencil/everything",
                           "lines/wide_perspective", "points/sizes", "fog/linear"}) {
    SCOPED_TRACE(file);
    expect_each_stage_alone(suite_scene(file));
  }
}

TEST(PipelineRenderer, LightAndShadeTakeTheRecordedLights) {
  Scene scene = boxes();
  for (const Stage stage : {Stage::light, Stage::shade}) {
    SCOPED_TRACE(name_of(stage));
    if (stage == Stage::shade) {
      for (Draw& draw : scene.draws) draw.shading = Shading::phong;
    }
    Scene other = scene;
    other.lights[0].vector = {-3, 1, 2};
    const auto pipeline = make_pipeline();
    Capture in = pipeline->capture(scene, everything());
    Capture none = in;
    none.records.lights.clear();
    const Capture as_it_was = pipeline->run_stage(scene, stage, none);
    const Capture expected = pipeline->run_stage(other, stage, none);
    in.records.lights = pipeline->capture(other, everything()).records.lights;
    ASSERT_EQ(in.records.lights.size(), scene.lights.size());
    const Capture made = pipeline->run_stage(scene, stage, in);
    EXPECT_THAT(differing_records(made, expected), IsEmpty());
    const auto color = [&](const Capture& c) {
      return stage == Stage::light ? c.records.lit.at(0).color : c.records.shaded.at(0).color;
    };
    EXPECT_NE(color(made), color(as_it_was));
  }
}

TEST(PipelineRenderer, DepthsOfAnotherRendererAreRoundedToTheFormat) {
  const Scene scene = boxes(ColorFormat::rgba8, DepthFormat::z16);
  const auto pipeline = make_pipeline();
  const Capture whole = pipeline->capture(scene, everything());
  for (double off : {-0.49, 0.49}) {
    Capture in;
    in.records = whole.records;
    for (double& z : in.records.depth) z += off / 65535;
    for (const Stage stage : {Stage::visibility, Stage::merge}) {
      EXPECT_THAT(differing_planes(pipeline->run_stage(scene, stage, in), of_stage(whole, stage)), IsEmpty());
    }
  }
}

TEST(PipelineRenderer, MergeTakesTheWinnersThatItIsGiven) {
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  Capture whole = pipeline->capture(scene, everything());
  const Capture merged = of_stage(whole, Stage::merge);
  EXPECT_THAT(differing_planes(pipeline->run_stage(scene, Stage::merge, whole), merged), IsEmpty());
  Capture hidden = whole;
  hidden.records.drawn.assign(whole.records.covered.size(), {false});
  EXPECT_NEAR(pipeline->run_stage(scene, Stage::merge, hidden).planes.depth(45, 35), scene.frame.clear_depth, 0x1p-24);
  whole.records.drawn.clear();  // where they are not told, the winners are
  EXPECT_THAT(differing_planes(pipeline->run_stage(scene, Stage::merge, whole), merged), IsEmpty());

  Capture none = whole;
  none.planes.id = Plane<std::int32_t>(90, 70, kBackground);
  const Capture cleared = pipeline->run_stage(scene, Stage::merge, none);
  for (const glm::vec4& c : cleared.planes.color.values()) {
    ASSERT_EQ(c, glm::round(scene.frame.clear_color * 255.0f) / 255.0f);
  }

  // One pixel's winner is another of its triangles, though that is farther away.
  const auto& r = whole.records;
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Covered& c = r.covered[i];
    const auto primitive = static_cast<std::int32_t>(r.triangles[c.triangle].primitive);
    if (c.x != 40 || c.y != 30 || primitive == whole.planes.id(40, 30)) continue;
    Capture other = whole;
    other.planes.id(40, 30) = primitive;
    const Planes planes = pipeline->run_stage(scene, Stage::merge, other).planes;
    EXPECT_EQ(planes.depth(40, 30), r.depth[i]);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(planes.color(40, 30)[k], r.shaded[i].color[k], 0.501 / 255);
    EXPECT_EQ(planes.color(41, 30), whole.planes.color(41, 30));
    return;
  }
  FAIL() << "the pixel has one triangle only";
}

TEST(PipelineRenderer, TrianglesBeyondTheFrameAreCutOff) {
  // A triangle over the whole frame and far beyond each of its sides, none of which is a block's.
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  Capture in;
  plumbline::WindowTriangle<double> t{{}, 5, true};
  const glm::dvec2 corners[] = {{-500, -500}, {2000, -500}, {-500, 2000}};
  for (std::size_t i = 0; i < 3; ++i) {
    t.v[i] = {glm::dvec3(corners[i], 0.5), 1, glm::ivec2(corners[i] * 256.0) - 128, glm::dvec4(1)};
  }
  in.records.triangles = {t};
  const Capture out = pipeline->run_stage(scene, Stage::coverage, in);
  EXPECT_EQ(out.planes.count.values(), Plane<std::uint32_t>::Values(90 * 70, 1));
  EXPECT_EQ(out.planes.id_sum.values(), Plane<std::uint64_t>::Values(90 * 70, id_weight(5)));
  EXPECT_EQ(out.records.covered.size(), 90u * 70u);
}

TEST(PipelineRenderer, HandsOutTheRecordsAskedForAndNoOthers) {
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  const Capture whole = pipeline->capture(scene, everything());
  for (std::size_t k = 0; k <= static_cast<std::size_t>(Stage::shade); ++k) {
    const auto stage = static_cast<Stage>(k);
    SCOPED_TRACE(kStageNames[k]);
    Request one;
    one.records = {stage};
    EXPECT_THAT(differing_records(pipeline->capture(scene, one), of_stage(whole, stage)), IsEmpty());
  }
}

TEST(PipelineRenderer, RecordsThatDoNotFitAreRefused) {
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  const Capture whole = pipeline->capture(scene, everything());
  const auto refused = [&](Stage stage, auto spoil) {
    SCOPED_TRACE(name_of(stage));
    Capture in = whole;
    spoil(in.records);
    EXPECT_THROW(pipeline->run_stage(scene, stage, in), std::logic_error);
  };
  refused(Stage::vertex, [](auto& r) { r.matrices.pop_back(); });
  refused(Stage::light, [](auto& r) { r.vertices.pop_back(); });
  refused(Stage::light, [](auto& r) { r.lights.emplace_back(); });
  refused(Stage::shade, [](auto& r) { r.lights.emplace_back(); });
  refused(Stage::clip, [](auto& r) { r.vertices.clear(); });
  refused(Stage::clip, [](auto& r) { r.lit.pop_back(); });
  refused(Stage::window, [](auto& r) { r.matrices.clear(); });
  refused(Stage::window, [](auto& r) { r.polygons.vertices.pop_back(); });
  refused(Stage::window, [](auto& r) { r.polygons.polygons[0].count = 29; });
  refused(Stage::window, [](auto& r) { r.polygons.polygons.back().primitive = 66; });
  refused(Stage::coverage, [](auto& r) { r.triangles.back().primitive = 66; });
  refused(Stage::depth, [](auto& r) { r.triangles.pop_back(); });
  refused(Stage::attributes, [](auto& r) { r.triangles.clear(); });
  refused(Stage::shade, [](auto& r) { r.attributes.pop_back(); });
  refused(Stage::visibility, [](auto& r) { r.depth.pop_back(); });
  refused(Stage::visibility, [](auto& r) { r.covered[5].x = 90; });
  refused(Stage::visibility, [](auto& r) { r.triangles[0].primitive = 66; });
  refused(Stage::visibility, [](auto& r) { r.covered[5].y = 70; });
  refused(Stage::visibility, [](auto& r) { std::swap(r.triangles.front(), r.triangles.back()); });
  refused(Stage::depth, [](auto& r) { std::swap(r.covered.front(), r.covered.back()); });
  refused(Stage::window, [](auto& r) { r.polygons.polygons.back().first += 1; });
  refused(Stage::window, [](auto& r) { r.polygons.polygons.back().first = 0xffffffffu; });
  refused(Stage::window, [](auto& r) { r.polygons.polygons[0].count = 2; });
  refused(Stage::coverage, [](auto& r) { r.triangles[0].corners = 2; });
  refused(Stage::window, [](auto& r) { std::swap(r.polygons.polygons.front(), r.polygons.polygons.back()); });
  refused(Stage::merge, [](auto& r) { r.shaded.pop_back(); });
  refused(Stage::merge, [](auto& r) { r.drawn.resize(1); });
  Capture in = whole;
  in.planes.id = Plane<std::int32_t>(70, 90, kBackground);
  EXPECT_THROW(pipeline->run_stage(scene, Stage::merge, in), std::logic_error) << "winners of another frame";
}

}  // namespace
}  // namespace plumbline::pipeline

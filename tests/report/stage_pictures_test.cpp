// Pictures of the stages: what they show of known captures, and where two differ.
#include "report/page/stage_pictures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "check/diagnose/diagnose.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "report/page/diagnosis_page.h"
#include "report/text/diagnosis_text.h"
#include "scene/antialias.h"
#include "tests/report/page_numbers.h"
#include "tests/suite.h"
#include "tests/text_file.h"

namespace plumbline::report {
namespace {

Scene textured_scene() { return suite_scene("texture/floor_linear_mipmap_linear"); }

Capture drawn(const Scene& scene) {
  Request request;
  request.records = StageSet::all();
  return pipeline::make_pipeline()->capture(scene, request);
}

const Layer& named(const std::vector<Layer>& layers, const char* name) {
  const auto found = std::ranges::find(layers, name, &Layer::name);
  EXPECT_NE(found, layers.end()) << name;
  return *found;
}

TEST(StageLayers, AreInTheOrderOfTheStagesAndOfTheFramesSize) {
  const Scene scene = textured_scene();
  const Capture c = drawn(scene);
  const std::vector<Layer> layers = stage_layers(scene, c, c);
  EXPECT_TRUE(std::ranges::is_sorted(layers, {}, [](const Layer& layer) { return layer.judged.front(); }));
  for (const char* name :
       {"fragments", "depth", "coordinates", "texel", "level of detail", "shaded", "primitives", "colour"}) {
    const Layer& layer = named(layers, name);
    ASSERT_EQ(layer.sides.size(), 2u) << name;
    EXPECT_EQ(layer.sides[0].values, layer.sides[1].values) << name;
    EXPECT_EQ(layer.sides[0].width, scene.frame.width) << name;
    EXPECT_EQ(layer.sides[0].height, scene.frame.height) << name;
  }
}

TEST(StageLayers, HoldTheNumbersOfBothSides) {
  const Scene scene = textured_scene();
  const Capture mine = drawn(scene);
  Capture expected = mine;
  expected.planes.color(7, 5) = glm::vec4(0.25f, 0.5f, 1, 1);
  expected.planes.count(3, 2) += 2;
  expected.planes.depth(9, 9) = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Layer> layers = stage_layers(scene, mine, expected);
  const auto width = static_cast<std::size_t>(scene.frame.width);
  const Numbers& color = named(layers, "colour").sides[1];
  const std::size_t at = 4 * (5 * width + 7);
  EXPECT_EQ(std::vector(color.values.begin() + static_cast<std::ptrdiff_t>(at),
                        color.values.begin() + static_cast<std::ptrdiff_t>(at) + 4),
            (std::vector<std::uint32_t>{64, 128, 255, 255}))
      << "codes, the nearest";
  const Layer& count = named(layers, "fragments");
  EXPECT_EQ(count.sides[1].values[2 * width + 3], count.sides[0].values[2 * width + 3] + 2);
  const Layer& depth = named(layers, "depth");
  EXPECT_EQ(depth.sides[0].scale, 16777215) << "codes";
  EXPECT_EQ(depth.sides[1].scale, 0) << "floats, for one is no number";
  EXPECT_TRUE(std::isnan(std::bit_cast<float>(depth.sides[1].values[9 * width + 9])));
  EXPECT_EQ(named(layers, "texel").sides[0].scale, 0);
}

TEST(StageLayers, WithoutRecordsShowWhatIsThere) {
  const Scene scene = textured_scene();
  Capture mine;
  mine.width = scene.frame.width;
  mine.height = scene.frame.height;
  mine.planes.color = Plane<glm::vec4>(mine.width, mine.height, glm::vec4(1, 0, 0, 1));
  const std::vector<Layer> layers = stage_layers(scene, mine, drawn(scene));
  EXPECT_TRUE(named(layers, "depth").sides[0].empty());
  EXPECT_FALSE(named(layers, "depth").sides[1].empty());
  EXPECT_FALSE(named(layers, "colour").sides[0].empty());
  EXPECT_TRUE(stage_layers(scene, {}, {}).empty());
}

TEST(PositionsDrawing, DrawsOursOnlyWhereItIsElsewhere) {
  const Scene scene = textured_scene();
  const Capture mine = drawn(scene);
  EXPECT_EQ(positions_drawing(scene, mine, mine).find("class=mine"), std::string::npos);
  Capture moved = mine;
  moved.records.triangles[0].v[0].snapped.x += 1;  // what rounding may do
  EXPECT_EQ(positions_drawing(scene, mine, moved).find("class=mine"), std::string::npos);
  moved.records.triangles[0].v[0].snapped.x += 1;
  const std::string drawing = positions_drawing(scene, mine, moved);
  EXPECT_NE(drawing.find("class=mine"), std::string::npos);
  EXPECT_EQ(drawing.find("class=mine"), drawing.rfind("class=mine")) << "of one triangle";
  EXPECT_EQ(positions_drawing(scene, mine, moved, 1).find("class=same"), std::string::npos) << "differing ones first";
  EXPECT_EQ(positions_drawing(scene, {}, mine), "");
}

nlohmann::json views_of(const Scene& scene, std::span<const Pictured> pictured, const check::Diagnosis& diagnosis) {
  const auto folder = std::filesystem::path(testing::TempDir()) / "plumbline_diagnosis_page";
  std::filesystem::remove_all(folder);
  PageFolder page_folder(folder);
  write_diagnosis_page(page_folder, scene, diagnosis, pictured);
  const std::string page = test::text_of(folder / "index.html");
  std::filesystem::remove_all(folder);
  const std::string from = "id=\"diagnosis\">";
  EXPECT_EQ(page.find("src="), std::string::npos) << "it is one file";
  const std::size_t begin = page.find(from) + from.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin))["views"];
}

TEST(DiagnosisPage, BeginsAtTheFirstDifferentStageAndMarksItsPixels) {
  const Scene scene = textured_scene();
  const auto exact = exact::make_exact();
  check::Diagnosis diagnosis;
  check::Measurement m;
  m.items = 10, m.differing = 1;
  m.differing_at = {{4, 2}};
  for (const check::JudgeId& judge : {check::JudgeId("osmesa"), check::JudgeId("exact", check::Kind::per_stage)})
    diagnosis.verdict.comparisons.push_back(check::judged("s", judge, Stage::texture, m));
  diagnosis.first = Stage::texture;
  const Pictured one[] = {{"stage by stage", scene, drawn(scene), check::expected_capture(scene, *exact)}};
  const nlohmann::json views = views_of(scene, one, diagnosis);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_EQ(views[0]["first"], 1);
  const nlohmann::json& view = views[0]["view"];
  EXPECT_EQ(view["sides"], (nlohmann::json{"drawn", "expected"}));
  EXPECT_EQ(view["layers"].size(), 8u);
  ASSERT_EQ(view["marks"].size(), 1u);
  const std::vector<std::uint32_t> marks = unpacked({{"data", view["marks"][0]}, {"bytes", 1}, {"channels", 1}});
  EXPECT_EQ(std::ranges::count(marks, 1u), 1);
  EXPECT_EQ(marks[static_cast<std::size_t>(2 * scene.frame.width + 4)], 1u);
}

TEST(DiagnosisText, SaysWhatMakesTheFirstStageNoMistake) {
  const auto text_of = [](Stage stage, check::Outcome from_scene) {
    check::Diagnosis diagnosis;
    diagnosis.first = stage;
    for (const check::Kind kind : {check::Kind::per_stage, check::Kind::from_scene}) {
      check::Comparison row = check::not_judged("", {"exact", kind}, stage, from_scene, "");
      if (kind == check::Kind::per_stage) row.outcome = check::Outcome::different;
      row.measurement.items = 9;
      diagnosis.verdict.comparisons.push_back(row);
    }
    return diagnosis_text(diagnosis);
  };
  const std::string order = "fragments drawn in another order, do this\n";
  EXPECT_NE(text_of(Stage::visibility, check::Outcome::ambiguous_only).find(order), std::string::npos);
  EXPECT_NE(text_of(Stage::merge, check::Outcome::within).find(order), std::string::npos);
  EXPECT_EQ(text_of(Stage::visibility, check::Outcome::different).find(order), std::string::npos);
  EXPECT_EQ(text_of(Stage::shade, check::Outcome::within).find(order), std::string::npos);
}

TEST(DiagnosisPage, OfAnAntialiasedSceneShowsTheFrameAndAPass) {
  const Scene scene = suite_scene("antialias/supersample_3");
  const Scene pass = passes_of(scene).front();
  const Capture frame = pipeline::make_pipeline()->capture(scene, Request{});
  check::Diagnosis diagnosis;
  check::Measurement m;
  m.items = 10, m.differing = 1;
  for (const Stage stage : {Stage::shade, Stage::resolve})
    diagnosis.verdict.comparisons.push_back(check::judged("s", {"exact", check::Kind::per_stage}, stage, m));
  diagnosis.first = Stage::resolve;
  const Pictured both[] = {{"the frame", scene, frame, frame}, {"a pass", pass, drawn(pass), {}}};
  const nlohmann::json views = views_of(scene, both, diagnosis);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0]["view"]["width"], scene.frame.width);
  EXPECT_EQ(views[1]["view"]["width"], 3 * scene.frame.width);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto rows = nlohmann::json::parse(inflated(views[i]["view"]["comparisons"].get<std::string>()));
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0]["stage"], i == 0 ? "resolve" : "shade");
  }
  EXPECT_EQ(views[0]["first"], 0);
  EXPECT_TRUE(views[1]["first"].is_null());
}

}  // namespace
}  // namespace plumbline::report

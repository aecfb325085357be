// Pictures of the stages: what they show of known captures, and where two differ.
#include "report/stage_pictures.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "check/diagnose.h"
#include "pipeline/pipeline_renderer.h"
#include "reference/exact/exact.h"
#include "report/diagnosis_page.h"
#include "scene/scene_file.h"

namespace plumbline::report {
namespace {

Scene textured_scene() {
  return load_scene(PLUMBLINE_SOURCE_DIR "/tests/scenes/texture/floor_linear_mipmap_linear.json", {});
}

Capture drawn(const Scene& scene) {
  Request request;
  request.records = StageSet::all();
  return pipeline::make_pipeline()->capture(scene, request);
}

const StagePicture& named(const std::vector<StagePicture>& pictures, const std::string& name) {
  const auto found = std::ranges::find(pictures, name, &StagePicture::name);
  EXPECT_NE(found, pictures.end()) << name;
  return *found;
}

TEST(StagePictures, AreInTheOrderOfTheStagesAndShowNoDifferenceToThemselves) {
  const Scene scene = textured_scene();
  const Capture c = drawn(scene);
  const auto pictures = stage_pictures(scene, c, c);
  EXPECT_TRUE(std::ranges::is_sorted(pictures, {}, &StagePicture::stage));
  for (const char* name :
       {"coverage", "depth", "texture-coordinates", "texel", "level-of-detail", "shaded", "primitives", "colour"}) {
    const StagePicture& picture = named(pictures, name);
    EXPECT_EQ(picture.differing, 0u) << name;
    EXPECT_EQ(picture.mine.values(), picture.expected.values()) << name;
    EXPECT_EQ(picture.mine.width(), scene.frame.width) << name;
    const auto red = [](const glm::vec4& p) { return p.r != p.g; };
    EXPECT_TRUE(std::ranges::none_of(picture.differences.values(), red)) << name;
  }
}

TEST(StagePictures, OnePixelThatDiffersIsRedAndItsDifferenceSaid) {
  const Scene scene = textured_scene();
  const Capture mine = drawn(scene);
  Capture expected = mine;
  expected.planes.color(7, 5).g += 0.25f;
  expected.planes.count(3, 2) += 2;
  expected.planes.depth(9, 9) = std::numeric_limits<double>::quiet_NaN();
  const auto pictures = stage_pictures(scene, mine, expected);
  const StagePicture& colour = named(pictures, "colour");
  EXPECT_EQ(colour.differing, 1u);
  EXPECT_FLOAT_EQ(static_cast<float>(colour.largest), 0.25f);
  EXPECT_EQ(colour.differences(7, 5), glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(named(pictures, "coverage").differing, 1u);
  EXPECT_EQ(named(pictures, "coverage").largest, 2);
  EXPECT_EQ(named(pictures, "depth").differing, 1u) << "no number is no equal";
  EXPECT_EQ(named(pictures, "texel").differing, 0u);
}

TEST(StagePictures, WithoutRecordsShowWhatIsThere) {
  const Scene scene = textured_scene();
  Capture mine;
  mine.width = scene.frame.width;
  mine.height = scene.frame.height;
  mine.planes.color = Plane<glm::vec4>(mine.width, mine.height, glm::vec4(1, 0, 0, 1));
  const auto pictures = stage_pictures(scene, mine, drawn(scene));
  EXPECT_TRUE(named(pictures, "depth").mine.empty());
  EXPECT_TRUE(named(pictures, "depth").differences.empty());
  EXPECT_FALSE(named(pictures, "colour").differences.empty());
  Capture small = mine;
  small.planes.color = Plane<glm::vec4>(2, 2, glm::vec4(0));
  EXPECT_TRUE(named(stage_pictures(scene, small, drawn(scene)), "colour").differences.empty());
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
  EXPECT_EQ(positions_drawing(scene, {}, {}), "");
}

TEST(DiagnosisPage, HoldsThePicturesThatItNames) {
  const Scene scene = textured_scene();
  const auto candidate = pipeline::make_pipeline();
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"exact", exact.get()}};
  const auto folder = std::filesystem::path(testing::TempDir()) / "plumbline_diagnosis_page";
  std::filesystem::remove_all(folder);
  const check::Diagnosis diagnosis = check::diagnose(scene, *candidate, references);
  PageFolder page_folder(folder);
  write_diagnosis_page(page_folder, scene, diagnosis, drawn(scene), check::expected_capture(scene, *exact));
  std::ostringstream text;
  text << std::ifstream(folder / "index.html").rdbuf();
  const std::string page = text.str();
  int pictures = 0;
  for (std::size_t at = 0; (at = page.find("src=\"", at)) != std::string::npos; ++at) {
    const std::string name = page.substr(at + 5, page.find('"', at + 5) - at - 5);
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
    ++pictures;
  }
  EXPECT_GE(pictures, 40) << "eight pictures, each alone and under the slider";
  EXPECT_EQ(page.find("http"), std::string::npos) << "it works offline";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace plumbline::report

// plumb diagnose --pixel.
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

const std::string kWindows = kScenes + "scissor/windows.json";

TEST_F(Cli, APixelsHistoryFollowsTheDiagnosis) {
  const Outcome run = plumb("diagnose " + kWindows + " --against exact --pixel 70,60 --json " + at("out.json"));
  EXPECT_EQ(run.code, 0) << run.text;
  const std::size_t history = run.text.find("\npixel 70,60 of ");
  ASSERT_NE(history, std::string::npos) << run.text;
  EXPECT_NE(run.text.find("winner: depth ", history), std::string::npos) << run.text;
  EXPECT_NE(run.text.find("scissor: not in the box from 0,0", history), std::string::npos) << run.text;
  const std::string json = test::text_of(at("out.json"));
  EXPECT_NE(json.find("\"pixel_history\": {"), std::string::npos);
  EXPECT_NE(json.find("\"fate\": \"winner\""), std::string::npos);
}

// Corners half a pixel off are right in a renderer that samples pixels at their corners.
TEST_F(Cli, APixelsHistoryIsByTheConventions) {
  const std::string by = "diagnose " + kSharedEdges +
                         " --against exact --pixel 98,5 --program '" PLUMBLINE_PLUMB
                         " capture {scene} {output} --fault window.half_pixel_off'";
  const Outcome none = plumb(by);
  EXPECT_TRUE(none.says("exact: legal here: primitive 24,")) << none.text;
  EXPECT_TRUE(none.says(" = code ")) << none.text;
  EXPECT_TRUE(none.says("codes\n")) << none.text;
  test::write_text(at("c.json"),
                   R"({"format": "plumbline conventions", "version": 1, "sample": [0, 0], "depth_format": "z32f"})");
  const Outcome declared = plumb(by + " --conventions " + at("c.json"));
  EXPECT_TRUE(declared.says("tie rule; what is legal: by " + at("c.json") + "\n")) << declared.text;
  EXPECT_TRUE(declared.says("exact: legal here: primitive 23,")) << declared.text;
  EXPECT_FALSE(declared.says(" = code ")) << declared.text;
}

TEST_F(Cli, APixelsHistoryHasTheLegalColorsOfBlendedFragments) {
  const std::string scene = kScenes + "blend/glow.json";
  const Outcome run = plumb("diagnose " + scene + " --against exact --pixel 20,20 --json " + at("out.json"));
  EXPECT_TRUE(run.says("exact: legal here: colour (")) << run.text;
  EXPECT_NE(test::text_of(at("out.json")).find("\"legal_colors\": {"), std::string::npos);
}

TEST_F(Cli, WithoutItThereIsNone) {
  const Outcome run = plumb("diagnose " + kWindows + " --against exact --json " + at("out.json"));
  EXPECT_FALSE(run.says("\npixel ")) << run.text;
  EXPECT_EQ(test::text_of(at("out.json")).find("pixel_history"), std::string::npos);
}

TEST_F(Cli, ABadPixelEndsTheRunWithTheFramesSize) {
  const Outcome fits = plumb("diagnose " + kWindows + " --against exact --pixel 0,0");
  EXPECT_EQ(fits.code, 0) << fits.text;
  for (const char* bad : {"5", "5,x", "5,5,5", "' 5,5'", "-1,0", "97,0", "0,83", "99999999999,1"}) {
    const Outcome run = plumb("diagnose " + kWindows + " --against exact --json " + at("out.json") + " --pixel=" + bad);
    EXPECT_EQ(run.code, 2) << bad;
    EXPECT_TRUE(run.says("expected X,Y, a pixel of the frame's ")) << bad << ": " << run.text;
    EXPECT_TRUE(entries().empty()) << bad;
  }
}

}  // namespace
}  // namespace plumbline

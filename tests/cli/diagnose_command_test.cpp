// plumb diagnose: ours, a fault, what another renderer left, and a program.
#include <tuple>

#include <fmt/format.h>

#include "base/atomic_path.h"
#include "capture/files/image_file.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

TEST_F(Cli, DiagnoseOfOursEnds0AndNamesNothing) {
  const Outcome run = plumb("diagnose " + kSharedEdges + " --against exact");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("first different stage: none\nwrong by itself: none\n")) << run.text;
  EXPECT_TRUE(run.says("   coverage    equal              equal\n")) << run.text;
  EXPECT_FALSE(run.says("->"));
}

TEST_F(Cli, DiagnoseOfAFaultEnds1AndSaysStageNumbersCauseAndPicture) {
  const Outcome run =
      plumb("diagnose " + kSharedEdges + " --against exact --fault coverage.inclusive_edges --json " + at("d.json"));
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("-> coverage ")) << run.text;
  EXPECT_TRUE(run.says("first different stage: coverage (against exact, from scene; exact, per stage)"));
  EXPECT_TRUE(run.says("wrong by itself: coverage\n"));
  EXPECT_TRUE(run.says("  its corner 2: p_win (32.5 32.5 0.444444478)"));
  EXPECT_TRUE(run.says("likely cause: covered sets differ only on edges, all of them extra"));
  EXPECT_TRUE(run.says("1 extra (!); lower left is pixel 32,32\n"));
  EXPECT_TRUE(run.says("\n!....")) << "the lowest row";
  const std::string json = test::text_of(at("d.json"));
  for (const char* part : {"\"first\": \"coverage\"", "\"wrong\": [\n  \"coverage\"\n ]", "\"causes\": [",
                           "\"picture\": ", "\"title\": \"exact, per stage\"", "\"versions\": {"}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << "\n" << json.substr(0, 2000);
  }
}

TEST_F(Cli, DiagnoseOfAFolderJudgesWhatIsInIt) {
  ASSERT_EQ(plumb("capture " + kSharedEdges + " " + at("good")).code, 0);
  const Outcome good = plumb("diagnose " + kSharedEdges + " --against exact --capture " + at("good"));
  EXPECT_EQ(good.code, 0) << good.text;
  const std::string on_centres = kScenes + "coverage/on_centres.json";
  ASSERT_EQ(plumb("capture " + on_centres + " " + at("bad") + " --fault coverage.top_for_bottom").code, 0);
  const Outcome bad = plumb("diagnose " + on_centres + " --against exact --capture " + at("bad"));
  EXPECT_EQ(bad.code, 1) << bad.text;
  EXPECT_TRUE(bad.says("wrong by itself: coverage\n"));
  EXPECT_TRUE(bad.says("first different stage: none; legal, but not by the tie rule that is judged by: coverage\n"))
      << bad.text;
  EXPECT_FALSE(bad.says(", repaired")) << "its stages cannot be called";
}

TEST_F(Cli, DiagnoseRefusesAFolderThatIsNotOfTheScene) {
  ASSERT_EQ(plumb("capture " + kSharedEdges + " " + at("capture")).code, 0);
  const std::string folder = " --against exact --capture " + at("capture");
  const Outcome size = plumb("diagnose " + kScenes + "frame/odd_129x17.json" + folder);
  EXPECT_EQ(size.code, 2);
  EXPECT_TRUE(size.says(at("capture") + ": expected a capture of the scene's 129 x 17 pixels, found one of "))
      << size.text;
  const Outcome vertices = plumb("diagnose " + kScenes + "interpolation/w_ratio.json" + folder);
  EXPECT_EQ(vertices.code, 2);
  EXPECT_TRUE(vertices.says("expected 13 vertices, as the scene has, found 65")) << vertices.text;
  const Outcome samples = plumb("diagnose " + kScenes + "antialias/samples_wedges.json" + folder);
  EXPECT_EQ(samples.code, 2);
  EXPECT_TRUE(samples.says("expected a scene of one sample a pixel")) << samples.text;
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + " --against exact --capture " + at("nothing")).code, 2);
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + folder + " --fault coverage.inclusive_edges").code, 2);
}

TEST_F(Cli, DiagnoseSeeksKnownFaultsUnlessToldNotTo) {
  const std::string line = "diagnose " + kSharedEdges +
                           " --against exact --program '" PLUMBLINE_PLUMB
                           " capture {scene} {output} --fault merge.blue_first'";
  const Outcome sought = plumb(line), unsought = plumb(line + " --no-causes");
  EXPECT_TRUE(sought.says("known faults that draw such a frame")) << sought.text;
  EXPECT_EQ(unsought.code, 1) << unsought.text;
  EXPECT_TRUE(unsought.says("known faults are not sought, by --no-causes\n")) << unsought.text;
  EXPECT_FALSE(unsought.says("known faults that draw such a frame")) << unsought.text;
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + " --picture x.png --no-causes").code, 2);
}

TEST_F(Cli, DiagnoseRunsAProgram) {
  const std::string program = "'" PLUMBLINE_PLUMB " capture {scene} {output}";
  const Outcome right = plumb("diagnose " + kSharedEdges + " --against exact --program " + program + "'");
  EXPECT_EQ(right.code, 0);
  EXPECT_TRUE(
      right.says("not judged: which triangle owns a sample on an edge (no tie rule is declared: plumb learn)\n"))
      << right.text;
  EXPECT_FALSE(plumb("diagnose " + kSharedEdges + " --against exact").says("owns a sample"));
  test::write_text(at("any.json"), R"({"format": "plumbline conventions", "version": 1, "tie_rule": "any"})");
  const Outcome any =
      plumb("diagnose " + kSharedEdges + " --against exact --program " + program + "' --conventions " + at("any.json"));
  EXPECT_TRUE(any.says("owns a sample on an edge (" + at("any.json") + " declares no tie rule)\n")) << any.text;
  const Outcome bad =
      plumb("diagnose " + kSharedEdges + " --against exact --program " + program + " --fault depth.truncated'");
  EXPECT_EQ(bad.code, 1) << bad.text;
  EXPECT_TRUE(bad.says("wrong by itself: depth\n")) << bad.text;
  const Outcome failed = plumb("diagnose " + kSharedEdges +
                               " --against exact --program 'sh -c \"echo no use >&2; exit 3\" {scene} {output}'");
  EXPECT_EQ(failed.code, 1);
  EXPECT_TRUE(failed.says("exited with status 3") && failed.says("no use")) << failed.text;
}

TEST_F(Cli, DiagnoseNamesLearnWhereNoKnownFaultExplainsAProgramsFrame) {
  const std::string judged =
      "diagnose " + kSharedEdges + " --against exact --program '" PLUMBLINE_PLUMB " capture {scene} {output}";
  const std::string said = "no known fault draws such a frame; the renderer's own conventions";
  const Outcome strange =
      plumb(judged + " && dd if=/dev/zero of={output}/planes.color.bin bs=1000 count=20 conv=notrunc'");
  EXPECT_EQ(strange.code, 1) << strange.text;
  EXPECT_TRUE(strange.says(said)) << strange.text;
  const Outcome known = plumb(judged + " --fault window.half_pixel_off'");
  EXPECT_EQ(known.code, 1) << known.text;
  EXPECT_FALSE(known.says(said)) << known.text;
  test::write_text(at("c.json"), R"({"format": "plumbline conventions", "version": 1})");
  const Outcome declared = plumb("diagnose " + kSharedEdges + " --against exact --conventions " + at("c.json") +
                                 " --program '" PLUMBLINE_C_RENDERER
                                 " {input} {output} && dd if=/dev/zero of={output}/planes.color.bin bs=1000 count=20 "
                                 "conv=notrunc'");
  EXPECT_TRUE(declared.says("\nno known fault draws such a frame\n")) << declared.text;
}

TEST_F(Cli, DiagnoseOfAPictureNamesTheBugsThatDrawIt) {
  ASSERT_EQ(plumb("render " + kSharedEdges + " -o " + at("right.png")).code, 0);
  const Outcome right = plumb("diagnose " + kSharedEdges + " --picture " + at("right.png"));
  EXPECT_EQ(right.code, 0) << right.text;
  EXPECT_TRUE(right.says(": 0 of ")) << right.text;
  ASSERT_EQ(plumb("render " + kSharedEdges + " -o " + at("wrong.png") + " --fault window.half_pixel_off").code, 0);
  const Outcome wrong = plumb("diagnose " + kSharedEdges + " --picture " + at("wrong.png"));
  EXPECT_EQ(wrong.code, 1) << wrong.text;
  EXPECT_TRUE(wrong.says(" 100.0 %            0  window.half_pixel_off ")) << wrong.text;
}

TEST_F(Cli, DiagnoseOfAPictureOfOneColorNamesNoFault) {
  const auto diagnosed = [&](const glm::vec4& color) {
    write_image(at("one.png"), Plane<glm::vec4>(112, 96, color));
    const Outcome run = plumb("diagnose " + kScenes + "texture/globe.json --picture " + at("one.png"));
    EXPECT_EQ(run.code, 1) << run.text;
    EXPECT_FALSE(run.says("likely stage")) << run.text;
    return run;
  };
  EXPECT_TRUE(
      diagnosed(glm::vec4(0)).says("the colour 0, 0, 0, and not the clear colour: nothing of the scene is seen"));
  EXPECT_TRUE(diagnosed(glm::vec4(1)).says("the colour 1, 1, 1, and not the clear colour"));
}

TEST_F(Cli, DiagnoseOfAPictureTakesItsDepthToo) {
  const std::string drawn =
      "render " + kScenes + "depth/functions.json -o " + at("picture.png") + " --depth " + at("z.exr");
  const std::string judged = "diagnose " + kScenes + "depth/functions.json --picture " + at("picture.png");
  ASSERT_EQ(plumb(drawn).code, 0);
  EXPECT_EQ(plumb(judged + " --depth " + at("z.exr")).code, 0);
  ASSERT_EQ(plumb(drawn + " --fault depth.at_corner").code, 0);
  EXPECT_EQ(plumb(judged).code, 0) << "the colours are right";
  const Outcome wrong = plumb(judged + " --depth " + at("z.exr"));
  EXPECT_EQ(wrong.code, 1) << wrong.text;
  EXPECT_TRUE(wrong.says(" 100.0 %            0  depth.at_corner ")) << wrong.text;
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + " --depth " + at("z.exr")).code, 2);
}

TEST_F(Cli, DiagnoseOfAPictureNamesDepthsOfAnotherConvention) {
  const std::string judged =
      "diagnose " + kScenes + "depth/functions.json --picture " + at("picture.png") + " --depth ";
  ASSERT_EQ(
      plumb("render " + kScenes + "depth/functions.json -o " + at("picture.png") + " --depth " + at("z.exr")).code, 0);
  for (const auto& [name, scale, offset] :
       {std::tuple("file.depth_of_ndc", 2.0, -1.0), {"file.depth_reversed", -1.0, 1.0}}) {
    Plane<double> depth = read_stored(at("z.exr")).channels.front().values;
    for (double& z : depth.values()) z = scale * z + offset;
    write_file(at("other.exr"), encode_depth_exr(at("other.exr"), depth));
    const Outcome run = plumb(judged + at("other.exr"));
    EXPECT_EQ(run.code, 1) << run.text;
    EXPECT_TRUE(run.says(fmt::format("likely stage: file (fault {})", name))) << run.text;
  }
}

TEST_F(Cli, DiagnoseOfACaptureNamesTheBugsThatDrawItsFrame) {
  ASSERT_EQ(plumb("capture " + kSharedEdges + " " + at("bad") + " --fault window.half_pixel_off").code, 0);
  const Outcome bad = plumb("diagnose " + kSharedEdges + " --against exact --capture " + at("bad"));
  EXPECT_EQ(bad.code, 1);
  EXPECT_TRUE(bad.says("known faults that draw such a frame:\n")) << bad.text;
  EXPECT_TRUE(bad.says(" 100.0 %            0  window.half_pixel_off ")) << bad.text;
}

TEST_F(Cli, DiagnoseOfAPictureRefusesWhatIsNoPictureOfTheScene) {
  ASSERT_EQ(plumb("render " + kScenes + "texture/globe.json -o " + at("other.png")).code, 0);
  const Outcome other = plumb("diagnose " + kSharedEdges + " --picture " + at("other.png"));
  EXPECT_EQ(other.code, 2) << other.text;
  EXPECT_TRUE(other.says("expected a picture of the scene's 128 x 128 pixels, found one of 112 x 96")) << other.text;
  ASSERT_EQ(plumb("render " + kSharedEdges + " -o " + at("color.exr")).code, 0);
  const Outcome depth =
      plumb("diagnose " + kSharedEdges + " --picture " + at("color.exr") + " --depth " + at("color.exr"));
  EXPECT_EQ(depth.code, 2) << depth.text;
  EXPECT_TRUE(depth.says("color.exr: expected one channel of window z, found 4")) << depth.text;
  test::write_text(at("cut.ppm"), "P6\n128 128\n255\n");
  const Outcome cut = plumb("diagnose " + kSharedEdges + " --picture " + at("cut.ppm"));
  EXPECT_EQ(cut.code, 2) << cut.text;
  EXPECT_TRUE(cut.says("cut.ppm: cannot be read: the file ends before its pixels do")) << cut.text;
  test::write_text(at("no.png"), "no picture");
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + " --picture " + at("no.png")).code, 2);
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + " --picture " + at("other.png") + " --fault depth.truncated").code, 2);
}

TEST_F(Cli, DiagnoseWritesAPageWithThePixelsHistoryOrNothing) {
  const Outcome run = plumb("diagnose " + kSharedEdges + " --against exact --pixel 32,32 --report " + at("page"));
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_NE(test::text_of(at("page/index.html")).find("pixel 32,32 of"), std::string::npos);
  fs::create_directories(at("full"));
  test::write_text(at("full/other"), "");
  const Outcome full = plumb("diagnose " + kSharedEdges + " --against exact --report " + at("full"));
  EXPECT_EQ(full.code, 2);
  EXPECT_FALSE(full.says("wrong by itself")) << "before the work";
}

}  // namespace
}  // namespace plumbline

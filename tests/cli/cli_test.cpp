// The program as a user meets it: arguments in, exit code, text and files out.
#include <fmt/format.h>

#include "capture/files/capture_folder.h"
#include "capture/files/image_file.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

TEST_F(Cli, HelpAndVersionEnd0AndBadUsage2) {
  EXPECT_EQ(plumb("--help").code, 0);
  EXPECT_EQ(plumb("--version").code, 0);
  EXPECT_EQ(plumb("").code, 2);
  EXPECT_NE(plumb("").text.find("render, check"), std::string::npos);
  EXPECT_EQ(plumb("chekc").code, 2);
  EXPECT_NE(plumb("chekc").text.find("chekc"), std::string::npos);
  EXPECT_EQ(plumb("check").code, 2);
  EXPECT_TRUE(plumb("check").says("plumb: check: scenes is required (--help shows all arguments)\n"));
  EXPECT_EQ(plumb("check " + kScenes + "cull --against mesa").code, 2);
  EXPECT_EQ(plumb("check " + kScenes + "cull --no-such-flag").code, 2);
  for (const char* jobs : {"0", "257", "-1", "1.5", "2x", "two", "''"}) {
    const Outcome run = plumb("check " + kScenes + "cull --jobs " + jobs);
    EXPECT_EQ(run.code, 2) << jobs;
    EXPECT_TRUE(run.says("plumb: check: --jobs: Value ") && run.says(" not in range ") && run.says("256")) << run.text;
  }
}

TEST_F(Cli, AMisspeltCommandOrOptionSaysWhatWasMeant) {
  const auto says = [](const std::string& arguments, const std::string& text) {
    const Outcome run = plumb(arguments);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says(text)) << run.text;
  };
  says("chek " + kSharedEdges, "found chek (did you mean \"check\"?)");
  says("golden updat", "found updat (did you mean \"update\"?)");
  says("check " + kSharedEdges + " --reprot page", "unexpected option --reprot (did you mean \"--report\"?)");
  says("report merge --json x", "plumb: report merge: unexpected option --json");
  says("check " + kSharedEdges + " --prog ./mine", "unexpected option --prog (did you mean \"--program\"?)");
  says("check " + kSharedEdges + " --fault window.y_fliped", "(did you mean \"window.y_flipped\"?)");
  says("check " + kSharedEdges + " --report " + at("q") + " --failures " + at("q/r"), "lies in the folder of --report");
  says("xyzzy", "expected a command: render, check, campaign, diagnose");
  EXPECT_FALSE(plumb("xyzzy").says("did you mean"));
}

TEST_F(Cli, CheckPrintsALineForEachSceneThatHoldsAndAllRowsOfTheOthers) {
  const std::string scenes =
      fmt::format("check {0}cull/both_windings.json {0}cull/set_and_unset.json --against exact ", kScenes);
  const Outcome hold = plumb(scenes);
  EXPECT_EQ(hold.code, 0);
  EXPECT_TRUE(hold.says("cull/both_windings           holds: ") && hold.says("cull/set_and_unset           holds: "));
  EXPECT_FALSE(hold.says("exact, per stage")) << hold.text;
  const Outcome wrong = plumb(scenes + "--fault coverage.inclusive_edges");
  EXPECT_EQ(wrong.code, 1);
  EXPECT_TRUE(wrong.says("cull/both_windings           holds: ") &&
              wrong.says("cull/set_and_unset           exact, per stage"));
  EXPECT_FALSE(wrong.says("cull/both_windings           exact")) << wrong.text;
  const Outcome all = plumb(scenes + "--verbose");
  EXPECT_TRUE(all.says("cull/both_windings           exact, per stage") && !all.says("holds: ")) << all.text;
  const Outcome single = plumb("check " + kScenes + "cull/both_windings.json --against exact");
  EXPECT_TRUE(single.says("cull/both_windings           exact, per stage") && !single.says("holds: ")) << single.text;
}

TEST_F(Cli, AClosedStandardOutputIsAnError) {
  for (const std::string& arguments : {"check " + kSharedEdges, std::string("list"), "diagnose " + kSharedEdges}) {
    for (const char* output : {">&-", ">/dev/full"}) {
      const Outcome run = shell(fmt::format("{} {} 2>&1 {}", PLUMBLINE_PLUMB, arguments, output));
      EXPECT_EQ(run.code, 2) << run.text;
      EXPECT_TRUE(run.says("plumb: standard output: cannot be written")) << run.text;
    }
  }
}

TEST_F(Cli, AMessageThatNobodyHearsIsNoCrash) {
  EXPECT_EQ(shell(PLUMBLINE_PLUMB " check /nowhere 2>&-").code, 2);
  EXPECT_EQ(shell(PLUMBLINE_PLUMB " xyzzy 2>&-").code, 2);
  EXPECT_EQ(shell(PLUMBLINE_PLUMB " list stages >&- 2>&-").code, 2);
}

TEST_F(Cli, ALimitOfFileSizesIsAnErrorWithAMessage) {
  const Outcome run = shell("ulimit -f 1; " PLUMBLINE_PLUMB " render " + kSharedEdges + " -o " + at("x.exr"));
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("x.exr: cannot be written: File too large")) << run.text;
  EXPECT_EQ(entries(), std::set<std::string>{});
}

TEST_F(Cli, CheckHoldsAndPrintsARowForEachReferenceAndStage) {
  const Outcome run = plumb("check " + kScenes + "cull/both_windings.json --against exact");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_NE(run.text.find("exact, per stage"), std::string::npos);
  EXPECT_NE(run.text.find("exact, from scene"), std::string::npos);
  for (const char* stage :
       {"matrices", "vertex", "light", "clip", "window", "coverage", "depth", "attributes", "merge"}) {
    EXPECT_NE(run.text.find(stage), std::string::npos) << stage;
  }
  EXPECT_NE(run.text.find("\nok:"), std::string::npos);
  const Outcome lines = plumb("check " + kScenes + "lines/star.json --against exact");
  EXPECT_EQ(lines.code, 0) << lines.text;
  EXPECT_EQ(lines.text.find("\nok:"), std::string::npos) << "something is unsupported: no bare ok";
}

TEST_F(Cli, AFaultEnds1AndNamesSceneStageAndTheCommandThatRepeatsIt) {
  const std::string scene = kScenes + "clip/each_plane.json";
  const Outcome run = plumb("check " + scene + " --against exact --fault clip.no_near_plane");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_NE(run.text.find("different clip/each_plane: first different stage: clip (against exact"), std::string::npos)
      << run.text;
  const std::string repeat = "check " + scene + " --against exact --fault clip.no_near_plane";
  EXPECT_NE(run.text.find("repeat: " PLUMBLINE_PLUMB " " + repeat), std::string::npos) << run.text;
}

TEST_F(Cli, TheCommandThatRepeatsWorksAsItStands) {
  fs::create_directories(folder_ / "a b");
  fs::create_symlink(PLUMBLINE_PLUMB, folder_ / "a b/it's plumb");
  const std::string scene = kScenes + "coverage/shared_edges.json";
  const Outcome run = shell("cd '" + at("a b") + "' && \"./it's plumb\" check " + scene +
                            " --against exact,exact --fault coverage.inclusive_edges --allow-missing");
  EXPECT_EQ(run.code, 1) << run.text;
  const std::string word = "repeat: ";
  const std::size_t from = run.text.find(word) + word.size();
  const std::string repeat = run.text.substr(from, run.text.find('\n', from) - from);
  EXPECT_TRUE(repeat.ends_with(" check " + scene + " --against exact --fault coverage.inclusive_edges --allow-missing"))
      << repeat;
  const Outcome again = shell("cd '" + at("a b") + "' && " + repeat);
  EXPECT_EQ(again.code, 1) << again.text;
  EXPECT_TRUE(again.says("repeat: " + repeat)) << again.text;
}

TEST_F(Cli, TheCommandThatRepeatsTakesNoFileForAnOption) {
  fs::copy(kScenes + "coverage/shared_edges.json", folder_ / "-a.json");
  const Outcome run =
      shell("cd '" + folder_.string() +
            "' && " PLUMBLINE_PLUMB " check --against exact --fault coverage.inclusive_edges -- -a.json");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("repeat: " PLUMBLINE_PLUMB " check ./-a.json --against exact")) << run.text;
}

TEST_F(Cli, ANoteTellsOnceWhatOfAMeshFileIsLeftOut) {
  test::write_text(folder_ / "mesh.obj", "mtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const fs::path scene = folder_ / "scene.json";
  test::write_text(
      scene,
      R"({"description": "two draws", "draws": [{"mesh": {"file": "mesh.obj"}}, {"mesh": {"file": "mesh.obj"}}]})");
  const Outcome run = plumb("check --against exact " + scene.string());
  EXPECT_EQ(run.code, 0) << run.text;
  const std::string note =
      "plumb: note: " + scene.string() + ": " + (folder_ / "mesh.obj").string() + ": materials of ";
  EXPECT_TRUE(run.says(note)) << run.text;
  EXPECT_EQ(run.text.find("note:"), run.text.rfind("note:")) << run.text;
}

TEST_F(Cli, FactorsAreNumbers) {
  for (const char* option : {"--moved", "--slower"}) {
    for (const char* value : {"nan", "0.5", "x", "inf"}) {
      const Outcome run = plumb("report diff a.json b.json " + std::string(option) + " " + value);
      EXPECT_EQ(run.code, 2) << run.text;
      EXPECT_TRUE(run.says(option)) << run.text;
    }
  }
}

TEST_F(Cli, AReferenceAskedForTwiceIsAskedOnce) {
  const std::string scene = kScenes + "cull/both_windings.json";
  const auto rows = [](std::string text) { return text.substr(0, text.rfind("comparisons in ")); };  // without times
  const Outcome once = plumb("check " + scene + " --against exact");
  EXPECT_EQ(rows(plumb("check " + scene + " --against exact,exact").text), rows(once.text));
  EXPECT_EQ(rows(plumb("check " + scene + " --against exact --against exact").text), rows(once.text));
}

TEST_F(Cli, AnUnknownFaultOrRendererEnds2) {
  const Outcome fault = plumb("check " + kScenes + "cull --fault vertex.nonsense");
  EXPECT_EQ(fault.code, 2);
  EXPECT_NE(fault.text.find("vertex.nonsense"), std::string::npos);
  const Outcome renderer = plumb("render " + kScenes + "cull/both_windings.json --with d3d -o " + at("x.png"));
  EXPECT_EQ(renderer.code, 2);
  EXPECT_NE(renderer.text.find("d3d"), std::string::npos);
  EXPECT_FALSE(fs::exists(at("x.png")));
}

TEST_F(Cli, ABadSceneEnds2AndNamesFileAndPlace) {
  const std::string file = scene_file(R"({"description": "x", "frame": {"width": 0}, "draws": []})");
  for (const std::string& command : {"check " + file, "render " + file + " -o " + at("x.png")}) {
    const Outcome run = plumb(command);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_NE(run.text.find(file), std::string::npos) << run.text;
    EXPECT_NE(run.text.find("/frame/width"), std::string::npos) << run.text;
  }
  EXPECT_FALSE(fs::exists(at("x.png")));
  EXPECT_EQ(plumb("check " + at("no_such.json")).code, 2);
  EXPECT_EQ(plumb("check " + folder_.string() + "/empty").code, 2);
}

TEST_F(Cli, AFrameOverTheBudgetOfMemoryEnds2AndNamesFileAndPlace) {
  const std::string file = scene_file(
      R"({"description": "x", "frame": {"width": 16384, "height": 16384}, "draws": [{"mesh": {"cube": {}}}]})");
  for (const std::string& command : {"check " + file, "render " + file + " -o " + at("x.png")}) {
    const Outcome run = plumb(command);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_NE(run.text.find(file + ": at \"/frame\": expected"), std::string::npos) << run.text;
  }
  EXPECT_FALSE(fs::exists(at("x.png")));
}

TEST_F(Cli, ABadSceneAmongGoodOnesLeavesNoReportHalfWritten) {
  fs::copy(kScenes + "cull/both_windings.json", folder_ / "a.json");
  scene_file("{");
  const Outcome run = plumb("check " + folder_.string() + " --against exact --json " + at("out.json"));
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_FALSE(fs::exists(at("out.json")));
}

TEST_F(Cli, RenderWritesPicturesAndDepth) {
  const std::string scene = kScenes + "cull/both_windings.json";
  const Outcome run = plumb("render " + scene + " -o " + at("c.png") + " --depth " + at("d.exr"));
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_GT(read_image(at("c.png")).size(), 0u);
  EXPECT_TRUE(fs::exists(at("d.exr")));
  EXPECT_EQ(plumb("render " + scene + " -o " + at("c.bmp")).code, 2);
  EXPECT_EQ(plumb("render " + scene + " -o " + at("no/such/folder/c.png")).code, 2);
  EXPECT_EQ(plumb("render " + scene + " -o " + at("e.png") + " --depth " + at("d.png")).code, 2);
  EXPECT_FALSE(fs::exists(at("e.png")));
}

TEST_F(Cli, TheDefinitionDrawsThePaintersPicture) {
  for (const std::string scene :
       {"antialias/samples_textured.json", "clip/six_planes.json", "notes/gzrender_cut.json"}) {
    ASSERT_EQ(plumb("render " + kScenes + scene + " -o " + at("p.png") + " --depth " + at("p.exr")).code, 0);
    const std::string outputs = " -o " + at("d.png") + " --depth " + at("d.exr");
    ASSERT_EQ(plumb("render " + kScenes + scene + " --with definition" + outputs).code, 0);
    EXPECT_EQ(read_image(at("d.png")).values(), read_image(at("p.png")).values()) << scene;
    EXPECT_EQ(read_image(at("d.exr")).values(), read_image(at("p.exr")).values()) << scene;
  }
}

TEST_F(Cli, APictureWhoseRowsCountFromTheTopStandsUpright) {
  const std::string scene = kScenes + "notes/gzrender_cut.json";
  ASSERT_EQ(plumb("render " + scene + " -o " + at("c.exr") + " --depth " + at("d.exr")).code, 0);
  ASSERT_EQ(plumb("capture " + scene + " " + at("capture")).code, 0);
  const Capture capture = read_capture(at("capture"));
  EXPECT_EQ(read_image(at("c.exr")).values(), upside_down(capture.planes.color).values());
  EXPECT_NE(read_image(at("c.exr")).values(), capture.planes.color.values());
  const Plane<double> depth = upside_down(read_stored(at("d.exr")).channels[0].values);
  for (std::size_t i = 0; i < depth.size(); ++i) {
    ASSERT_EQ(depth.values()[i], static_cast<float>(capture.planes.depth.values()[i]));
  }
}

// image_order finds visibility alone: its picture shows each primitive in its own colour.
TEST_F(Cli, ImageOrderJudgesVisibilityAndDrawsPrimitives) {
  const std::string scene = kScenes + "cull/both_windings.json";
  EXPECT_EQ(plumb("check " + scene + " --against image_order").code, 0);
  const Outcome fault =
      plumb("check " + kScenes + "clip/each_plane.json --against image_order --fault clip.no_near_plane");
  EXPECT_EQ(fault.code, 1) << fault.text;
  EXPECT_TRUE(fault.says("first different stage: visibility (against image_order)")) << fault.text;
  // Open pixels are settled by legal answers, which exact has.
  EXPECT_EQ(plumb("check " + kScenes + "coverage/fan.json --against exact,image_order").code, 0);
  // A frame that has stencil values, which no draw asks for.
  EXPECT_EQ(plumb("check " + kScenes + "phong/separate_on_a_floor.json --against exact,image_order").code, 0);

  const Outcome run = plumb("render " + scene + " --with image_order -o " + at("c.png") + " --depth " + at("d.exr"));
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_EQ(plumb("capture " + scene + " " + at("ours")).code, 0);
  const Plane<std::int32_t> ids = read_capture(at("ours")).planes.id;  // no pixel of this scene is open
  const Plane<glm::vec4> picture = read_image(at("c.png"));
  ASSERT_EQ(picture.size(), ids.size());
  std::set<std::int32_t> primitives;
  std::set<std::array<float, 3>> colors;
  std::set<std::pair<std::int32_t, std::array<float, 3>>> pairs;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const glm::vec4 c = picture.values()[i];
    primitives.insert(ids.values()[i]);
    colors.insert({c.r, c.g, c.b});
    pairs.insert({ids.values()[i], {c.r, c.g, c.b}});
  }
  EXPECT_GT(primitives.size(), 5u);
  EXPECT_EQ(colors.size(), primitives.size());
  EXPECT_EQ(pairs.size(), primitives.size()) << "one colour for each";
}

TEST_F(Cli, JsonAndPageAreWritten) {
  const Outcome run =
      plumb("check " + kScenes + "cull --against exact --json " + at("out.json") + " --report " + at("page"));
  EXPECT_EQ(run.code, 0) << run.text;
  const std::string json = test::text_of(at("out.json"));
  for (const char* key :
       {"\"versions\"", "\"comparisons\"", "\"scene\"", "\"reference\"", "\"stage\"", "\"outcome\"", "\"pixels\"",
        "\"differing\"", "\"ambiguous\"", "\"max_difference\"", "\"unit\"", "\"tolerance\"", "\"worst\""}) {
    EXPECT_NE(json.find(key), std::string::npos) << key;
  }
  EXPECT_NE(test::text_of(at("page/index.html")).find("cull/both_windings"), std::string::npos);
  for (const char* kind : {".png", ".js"}) EXPECT_TRUE(fs::exists(at("page/cull/both_windings") + kind)) << kind;
  EXPECT_EQ(plumb("check " + kScenes + "cull --against exact --json " + at("no/such/out.json")).code, 2);
}

TEST_F(Cli, CaptureWritesAFolderThatReadsBack) {
  const Outcome run = plumb("capture " + kScenes + "cull/both_windings.json " + at("capture") + " --with exact");
  EXPECT_EQ(run.code, 0) << run.text;
  const Capture capture = read_capture(at("capture"));
  EXPECT_EQ(capture.renderer, "exact");
  EXPECT_GT(capture.records.triangles.size(), 0u);
}

TEST_F(Cli, RenderWritesPicturesOfEveryEndingThatHoldsTheFormat) {
  const std::string scene = kScenes + "frame/rgba12.json";
  for (const char* file : {"c.png", "c.ppm", "c.exr"}) {
    const Outcome run = plumb("render " + scene + " -o " + at(file));
    EXPECT_EQ(run.code, 0) << run.text;
    const Plane<glm::vec4> picture = read_image(at(file));
    EXPECT_EQ(std::round(picture(0, 0).r * 4095), 410) << "0.1 of 4095, half to even, in " << file;
    EXPECT_EQ(std::round(picture(0, 0).b * 4095), 2048) << file;
  }
  const Outcome refused = plumb("render " + scene + " -o " + at("c.tga"));
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.text.find("c.tga: TGA holds 8 bits a channel"), std::string::npos) << refused.text;
  EXPECT_FALSE(fs::exists(at("c.tga")));
  EXPECT_EQ(plumb("render " + kScenes + "frame/one_pixel.json -o " + at("c.tga")).code, 0);
  EXPECT_EQ(read_image(at("c.tga")).size(), 1u);
}

TEST_F(Cli, ListNamesWhatThereIs) {
  const Outcome run = plumb("list");
  EXPECT_EQ(run.code, 0);
  for (const char* word : {"coverage", "ours", "exact", "window.snap_truncates"}) {
    EXPECT_NE(run.text.find(word), std::string::npos) << word;
  }
  const std::string scenes = plumb("list scenes " + kScenes + "frame").text;
  EXPECT_NE(scenes.find("frame/one_pixel"), std::string::npos);
  EXPECT_NE(scenes.find("77 x 45 x 12 bytes = 41580: GzRender's"), std::string::npos) << scenes;
  const Outcome superfluous = plumb("list stages extra");
  EXPECT_EQ(superfluous.code, 2);
  EXPECT_EQ(superfluous.text, "plumb: list stages: expected no folder, found extra\n");
}

TEST_F(Cli, CheckRefusesAFaultThatNoneIsBeforeItPrints) {
  const Outcome run = plumb("check " + kSharedEdges + " --fault coverage.inclusive_edge");
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(run.text,
            "plumb: no fault 'coverage.inclusive_edge' to put in (did you mean \"coverage.inclusive_edges\"?): plumb "
            "list faults shows those that --fault puts in first\n");
}

}  // namespace
}  // namespace plumbline

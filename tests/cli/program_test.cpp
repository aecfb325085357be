// Another renderer, run by a command line: its input, what becomes of its output, and the suite's summary.
#include <fstream>
#include <regex>

#include <fmt/format.h>

#include "cli/options/scene_arguments.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

const std::string kMine = "'" PLUMBLINE_C_RENDERER " {input} {output}'";
const std::string kRecorder = "'" PLUMBLINE_C_RECORDER " {serve}'";
const std::string kServer = "'" PLUMBLINE_C_RENDERER " {serve}'";

// Scenes of the line of a feature.
struct Tally {
  int right = -1, legal = -1, known = -1, wrong = -1, failed = -1, unable = -1;
};
Tally tally(const Outcome& run, const std::string& feature) {
  std::smatch found;
  const std::regex line("\n" + feature + " +(\\d+) +(\\d+) +(\\d+) +(\\d+) +(\\d+) +(\\d+) ");
  if (!std::regex_search(run.text, found, line)) return {};
  const auto number = [&](std::size_t i) { return std::stoi(found[i]); };
  return {number(1), number(2), number(3), number(4), number(5), number(6)};
}

TEST_F(Cli, ProgramIsHandedAnExportAndJudgedByColourAndDepth) {
  const Outcome run = plumb("diagnose " + kSharedEdges + " --against exact --program " + kMine);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("2 of 13 stages judged")) << run.text;
}

TEST_F(Cli, ProgramThatIsMissingIsRefusedBeforeTheWork) {
  for (const std::string& command : {"check " + kSharedEdges, "diagnose " + kSharedEdges, std::string("learn")}) {
    for (const char* program : {"./none_such", "none_such"}) {
      const Outcome run = plumb(command + " --program '" + program + " {serve}'");
      EXPECT_EQ(run.code, 2) << run.text;
      EXPECT_TRUE(run.says(std::string("--program: ") + program + ": expected a program that can be run, found none"))
          << run.text;
    }
  }
}

TEST_F(Cli, ProgramOfASuiteEndsWithARowPerFeature) {
  std::string groups;
  for (const char* group : {"clip", "coverage", "cull", "depth", "fog"}) groups += " " + kScenes + group;
  const Outcome run = plumb("check" + groups + " --program " + kServer);
  EXPECT_EQ(run.code, 0) << run.text;
  const Tally all = tally(run, "all");
  EXPECT_GE(all.right + all.wrong, 50) << run.text;
  EXPECT_GE(all.right, 45);
  EXPECT_EQ(all.failed, 0);
  EXPECT_EQ(tally(run, "fog").unable, 13);
  EXPECT_EQ(tally(run, "clip").right, 19);
  for (const char* line : {"unable: fog 13\n", "unable: a frame in which nothing is drawn holds, too 5"})
    EXPECT_TRUE(run.says(line)) << run.text;
}

// A renderer in double, of its own arithmetic, whose records are in arrays of f32 and f64, without derived columns.
TEST_F(Cli, ProgramThatShowsAllItsRecordsIsRightAtEveryStage) {
  for (const char* scene : {"coverage/fan", "clip/corners_on_planes", "light/sphere_gouraud", "depth/functions_z32f"}) {
    const Outcome run = plumb("diagnose " + kScenes + scene + ".json --program " + kRecorder);
    EXPECT_EQ(run.code, 0) << run.text;
    EXPECT_TRUE(run.says("11 of 13 stages judged")) << run.text;
    EXPECT_TRUE(run.says("first different stage: none")) << run.text;
  }
}

// The page of an earlier run would look like this run's.
TEST_F(Cli, ProgramThatFailsLeavesNoPageOfAnEarlierRun) {
  const auto diagnosed = [&](const std::string& program) {
    return plumb("diagnose " + kSharedEdges + " --report " + at("page") + " --program " + program);
  };
  EXPECT_EQ(diagnosed(kServer).code, 0);
  EXPECT_TRUE(fs::exists(at("page/index.html")));
  const Outcome failed = diagnosed("'false {input} {output}'");
  EXPECT_NE(failed.code, 0) << failed.text;
  EXPECT_EQ(fs::exists(at("page/index.html")), failed.says("page: ")) << failed.text;
  EXPECT_EQ(diagnosed(kServer).code, 0);
  EXPECT_TRUE(fs::exists(at("page/index.html")));
}

// Another file of the program than main()'s refuses the scene.
TEST_F(Cli, ProgramOfSeveralFilesMayRefuseASceneInAnyOfThem) {
  const Outcome run =
      plumb("check " + kScenes + "light/reflection_colors.json " + kSharedEdges + " --program " + kRecorder);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("unable: specular reflection 1")) << run.text;
}

// Browsers and virtual machines reserve more addresses than there is memory.
TEST_F(Cli, ProgramIsLimitedInWhatItWritesToNotInItsAddresses) {
  const Outcome run = plumb("check " + kSharedEdges +
                            " --program 'echo v $(ulimit -v) d $(ulimit -H -d) >&2; exit 77; {input} {output}'");
  EXPECT_TRUE(run.says("v unlimited d ")) << run.text;
  EXPECT_FALSE(run.says("d unlimited")) << run.text;
}

TEST_F(Cli, ProgramOfACourseIsGradedSceneByScene) {
  for (const std::string course : {"gl", "games101", "gzrender", "tinyrenderer"}) {
    const std::string scenes = PLUMBLINE_SOURCE_DIR "/tests/homework/" + course;
    const Outcome ours = plumb("check " + scenes);
    EXPECT_EQ(ours.code, 0) << ours.text;
    EXPECT_TRUE(ours.says("22 scenes")) << ours.text;
    const std::string grades = at(course + ".json");
    const Outcome run =
        plumb("check " + scenes + " --program " + kServer + " --grade " + scenes + ".rubric.json --grades " + grades);
    EXPECT_EQ(run.code, 0) << run.text;
    std::ifstream in(grades);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    // All but four textures and one light per fragment.
    EXPECT_NE(text.find("\"score\": 85.0"), text.npos) << text;
    EXPECT_NE(text.find("there is no texture"), text.npos) << "the hint";
  }
}

TEST_F(Cli, HomeworkShowsWhatAFrameCouldHide) {
  const auto differs = [&](const std::string& course, const std::string& fault, const std::string& scene) {
    const Outcome run =
        plumb("check " PLUMBLINE_SOURCE_DIR "/tests/homework/" + course + "/" + scene + ".json --fault " + fault);
    EXPECT_EQ(run.code, 1) << course << ' ' << fault << '\n' << run.text;
  };
  for (const char* course : {"gl", "games101", "gzrender", "tinyrenderer"})
    differs(course, "visibility.less_equal", "11_nearer_first");
  for (const char* course : {"gl", "games101"}) {
    differs(course, "clip.no_near_plane", "13_behind_the_eye");
    differs(course, "clip.no_far_plane", "13_behind_the_eye");
  }
}

TEST_F(Cli, ProgramMayBeginInClipOrWindowSpace) {
  const std::string diagnose =
      "diagnose " + kScenes + "coverage/fan.json --program 'GIVEN=1 " PLUMBLINE_C_RECORDER " {serve}'";
  const Outcome clip = plumb(diagnose + " --from clip"), window = plumb(diagnose + " --from window");
  EXPECT_EQ(clip.code, 0) << clip.text;
  EXPECT_TRUE(clip.says("8 of 13 stages judged")) << clip.text;
  EXPECT_TRUE(clip.says("not judged: matrices, vertex, light: given: --from clip")) << clip.text;
  EXPECT_EQ(window.code, 0) << window.text;
  EXPECT_TRUE(window.says("6 of 13 stages judged")) << window.text;
  EXPECT_TRUE(window.says("not judged: matrices, vertex, light, clip, window: given: --from window")) << window.text;
  EXPECT_EQ(plumb(diagnose + " --from coverage").code, 2);
  EXPECT_EQ(plumb("check " + kSharedEdges + " --from clip").code, 2) << "of a program alone";
}

TEST_F(Cli, ProgramOfEachSubmissionHasARow) {
  for (const auto& [name, line] : {std::pair("ada", PLUMBLINE_C_RENDERER " \"$@\""), std::pair("it's bob", "exit 3")}) {
    std::filesystem::create_directories(folder_ / "all" / name);
    test::write_text(folder_ / "all" / name / "run", line);
  }
  test::write_text(folder_ / "all" / "notes.txt", "no submission");
  test::write_text(folder_ / "rubric.json", R"({"title": "T", "scenes": {"coverage/shared_edges": {"points": 5}}})");
  const std::string check = "check " + kSharedEdges + " --submissions " + at("all") +
                            " --program 'sh {submission}/run {input} {output}' --grade " + at("rubric.json");
  const Outcome run = plumb(check + " --grades " + at("grades") + " --markdown " + at("table.md"));
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(std::regex_search(run.text, std::regex("\nada +5 of 5 +1 +0 +0 +0 +0"))) << run.text;
  EXPECT_TRUE(std::regex_search(run.text, std::regex("\nit's bob +0 of 5 +0 +0 +0 +1 +0"))) << run.text;
  EXPECT_NE(test::text_of(folder_ / "grades" / "ada.json").find("\"score\": 5.0"), std::string::npos);
  EXPECT_NE(test::text_of(folder_ / "grades" / "it's bob.json").find("\"score\": 0.0"), std::string::npos);
  EXPECT_NE(test::text_of(folder_ / "table.md").find("| ada | 5 of 5 | 1 | 0 | 0 | 0 | 0 |"), std::string::npos);
  std::filesystem::remove_all(folder_ / "all" / "it's bob");
  const std::string far_plane = "check " + kScenes + "clip/along_the_far_plane.json --submissions " + at("all") +
                                " --program 'sh {submission}/run {input} {output}'";
  const Outcome unable = plumb(far_plane);
  EXPECT_EQ(unable.code, 1) << "nothing could be judged: " << unable.text;
  EXPECT_TRUE(std::regex_search(unable.text, std::regex("\nada +- +0 +0 +0 +0 +1"))) << unable.text;
  EXPECT_EQ(
      plumb("check " + kSharedEdges + " --submissions " + at("none") + " --program 'sh {submission} {input} {output}'")
          .code,
      2);
  EXPECT_EQ(plumb("check " + kSharedEdges + " --submissions " + at("all") + " --program 'sh {input} {output}'").code,
            2);
  EXPECT_EQ(plumb("check " + kSharedEdges + " --submissions " + at("all")).code, 2);
}

// A known bug, in another program: it is counted over the scenes.
TEST_F(Cli, ProgramThatIsWrongIsToldByWhichKnownFaults) {
  const std::string check =
      "check " + kScenes + "camera/transform_chain.json " + kScenes + "light/sphere_gouraud.json --program " +
      "'" PLUMBLINE_PLUMB " capture {scene} {output}/all --fault merge.blue_first && mv {output}/all/* {output}'";
  const Outcome run = plumb(check);
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("wrong as by file (fault file.bgr), or merge (fault merge.blue_first): 2, first camera"))
      << run.text;
  EXPECT_FALSE(run.says("drawn otherwise")) << run.text;
  const Outcome unsought = plumb(check + " --no-causes");
  EXPECT_EQ(unsought.code, 1) << unsought.text;
  EXPECT_TRUE(unsought.says("wrong, and known faults are not sought, by --no-causes: 2, first camera/transform_chain"))
      << unsought.text;
}

// Records of a mistake beside the frame of a right renderer: no known fault draws such a frame.
TEST_F(Cli, ProgramThatIsWrongInItsRecordsIsToldTheirCause) {
  const std::string capture = PLUMBLINE_PLUMB " capture {scene} {output}";
  const Outcome run = plumb("check " + kScenes + "camera/transform_chain.json --program '" + capture +
                            "/wrong --fault attributes.next_corner && " + capture +
                            "/right && mv {output}/wrong/* {output} && mv {output}/right/planes.color.* {output}'");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("wrong as by attributes (each corner has the next one's attributes): 1, first camera/"))
      << run.text;
}

// A server that draws its first scene again and again, then one that ends after it: by itself, each scene is right.
TEST_F(Cli, ProgramThatKeepsAStateIsToldSo) {
  test::write_text(folder_ / "mine",
                   "#!/bin/sh\n"
                   "kept=$TMPDIR/kept\n"
                   "while IFS=\"$(printf '\\t')\" read -r in out; do\n" PLUMBLINE_C_RENDERER
                   " \"$in\" \"$out\" || exit\n"
                   "  if [ -d \"$kept\" ]; then cp \"$kept\"/* \"$out\"; else cp -r \"$out\" \"$kept\"; fi\n"
                   "  echo ok\n"
                   "done\n");
  fs::permissions(folder_ / "mine", fs::perms::owner_all);
  const std::string two = kSharedEdges + " " + kScenes + "interpolation/w_ratio.json --against exact --jobs 1";
  const Outcome run = plumb("check " + two + " --program '" + at("mine") + " {serve}'");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_EQ(tally(run, "coverage").right, 1) << run.text;
  EXPECT_TRUE(
      run.says("wrong, and drawn otherwise by the program when it is started for this scene alone: 1, first "
               "interpolation/w_ratio"))
      << run.text;
  test::write_text(folder_ / "mine",
                   "#!/bin/sh\n"
                   "IFS=\"$(printf '\\t')\" read -r in out\n" PLUMBLINE_C_RENDERER " \"$in\" \"$out\" && echo ok\n");
  const Outcome one = plumb("check " + two + " --program '" + at("mine") + " {serve}'");
  EXPECT_EQ(one.code, 1) << one.text;
  EXPECT_TRUE(
      one.says("failed, and drawn by the program when it is started for this scene alone: 1, first "
               "interpolation/w_ratio"))
      << one.text;
}

TEST_F(Cli, ProgramThatDrawsNoSceneEnds2) {
  for (const std::string& command :
       {std::string("'sh -c \"echo no fog here >&2; exit 77\" {input} {output}'"), kServer}) {
    const Outcome run = plumb("check " + kScenes + "fog/backwards.json --program " + command);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says("--program: expected a scene that it draws and that can be judged, found none")) << run.text;
    EXPECT_TRUE(run.says("fog")) << run.text;
  }
}

TEST_F(Cli, ProgramThatFailsIsAFailedRow) {
  const Outcome run = plumb("check " + kSharedEdges + " --program 'false {input} {output}'");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("exited with status 1")) << run.text;
  EXPECT_EQ(tally(run, "coverage").failed, 1) << run.text;
}

// A program that fails alike on every scene: its stderr stands once, and conventions are no explanation.
TEST_F(Cli, ProgramThatFailsEverywhereTellsWhyOnce) {
  const Outcome run = plumb("check " + kSharedEdges + " " + kScenes + "cull/both_windings.json" +
                            " --against exact --program 'echo no such key >&2; exit 3; {input} {output}'");
  EXPECT_EQ(run.code, 1) << run.text;
  const std::size_t first = run.text.find("no such key\n  repeat: ");
  ASSERT_NE(first, std::string::npos) << run.text;
  EXPECT_EQ(run.text.find("\nno such key", first + 1), std::string::npos) << run.text;
  EXPECT_TRUE(run.says("exited with status 3; its stderr is that of ")) << run.text;
  EXPECT_FALSE(run.says("plumb learn --program")) << run.text;
}

TEST_F(Cli, ProgramIsALineOfTheShell) {
  const std::string here = fs::path(PLUMBLINE_C_RENDERER).parent_path().string();
  EXPECT_EQ(plumb("check " + kSharedEdges + " --program 'cd " + here + " && A=1 ./c_renderer {input} {output}'").code,
            0);
  EXPECT_EQ(plumb("check " + kSharedEdges + " --program '" PLUMBLINE_C_RENDERER " {input} {output} && false'").code, 1);
}

TEST_F(Cli, ProgramThatLeavesTooMuchFailsAtItsSceneAlone) {
  test::write_text(folder_ / "mine",
                   "#!/bin/sh\n" PLUMBLINE_C_RENDERER
                   " \"$1\" \"$2\"\n"
                   "case $(cat \"$1/manifest.json\") in *both_windings*) for i in 1 2; do truncate -s 400M "
                   "\"$2/$i\"; done;; esac\n");
  fs::permissions(folder_ / "mine", fs::perms::owner_all);
  const Outcome run =
      plumb("check " + kScenes + "cull " + kSharedEdges + " --program '" + at("mine") + " {input} {output}'");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("bytes in its folder, where a capture takes at most 536870912")) << run.text;
  EXPECT_EQ(tally(run, "cull").right, 3) << run.text;
  EXPECT_EQ(tally(run, "cull").failed, 1);
  EXPECT_EQ(tally(run, "coverage").right, 1);
}

TEST_F(Cli, ProgramWhoseCaptureContradictsItselfFails) {
  const std::string judged = kSharedEdges + " --against exact --program '" PLUMBLINE_PLUMB " capture {scene} {output}",
                    id = "{output}/planes.id.bin";
  for (const char* command : {"check ", "diagnose "}) {
    const Outcome none = plumb(std::string(command) + judged + " && tr \"\\000-\\377\" \"\\377\" <" + id +
                               " >{output}/id" + " && mv {output}/id " + id + "'");
    EXPECT_EQ(none.code, 1) << none.text;
    EXPECT_TRUE(none.says("the capture contradicts itself: planes.id: ")) << none.text;
    const Outcome probed = plumb(std::string(command) + judged + " && tr \"\\000-\\377\" \"\\377\" <" + id +
                                 " >{output}/id" + " && mv {output}/id " + id + "' --each-primitive");
    EXPECT_EQ(probed.code, 1) << "its own winners are not probed: " << probed.text;
    const Outcome beyond =
        plumb(std::string(command) + judged + " && printf AAAA | dd of=" + id + " bs=4 seek=5 conv=notrunc'");
    EXPECT_EQ(beyond.code, 1) << beyond.text;
    EXPECT_TRUE(beyond.says("program: planes.id: pixel 5, 0: expected -1 to ")) << beyond.text;
  }
}

TEST_F(Cli, ProgramThatCannotDrawASceneIsNotDiagnosed) {
  const Outcome run = plumb("diagnose " + kScenes + "fog/backwards.json --program " + kMine);
  EXPECT_EQ(run.code, 2) << run.text;
  EXPECT_TRUE(run.says("backwards.json: not judged: the program does not draw it: fog")) << run.text;
}

TEST_F(Cli, ProgramWantsASceneAndAFolder) {
  for (const char* command : {"./mine", "./mine {input}", "./mine {output}", "./mine {serve} {input}"}) {
    for (const char* of : {"check ", "diagnose "}) {
      const Outcome run = plumb(of + kSharedEdges + " --program '" + command + "'");
      EXPECT_EQ(run.code, 2) << command << run.text;
      EXPECT_TRUE(
          run.says("--program: expected {output} and {input} or {scene} in the command line, or {serve} alone, "
                   "found ./mine"))
          << run.text;
    }
  }
}

TEST_F(Cli, ProgramTakesPlaceholdersWithoutQuotesAfterAProgram) {
  const std::pair<const char*, const char*> kRefused[] = {
      {"./mine '{input}' {output}", "expected {input} without quotes, found '{input}'"},
      {"./mine {input} \"{output}\"", "expected {output} without quotes, found \"{output}\""},
      {"{serve}", "expected a program before {serve}, found {serve}"},
      {" {scene} {output}", "expected a program before {scene}, found  {scene} {output}"}};
  for (const auto& [command, says] : kRefused) {
    const Outcome run = plumb("check " + kSharedEdges + " --program " + cli::shell_word(command));
    EXPECT_EQ(run.code, 2) << command << run.text;
    EXPECT_TRUE(run.says(std::string("--program: ") + says)) << run.text;
  }
}

TEST_F(Cli, ProgramIsGraded) {
  test::write_text(at("rubric.json"), R"({"title": "Homework 1", "scenes": {
    "coverage/shared_edges": {"stages": {"depth": 2, "merge": 3}},
    "fog/backwards": {"points": 4, "hint": "Fog goes by the distance from the eye."}}})");
  const std::string run = "check " + kSharedEdges + " " + kScenes + "fog/backwards.json --program " + kMine +
                          " --grade " + at("rubric.json") + " --grades " + at("results.json");
  EXPECT_EQ(plumb(run + " --markdown " + at("page.md")).code, 0);
  const std::string results = test::text_of(at("results.json"));
  EXPECT_NE(results.find("\"score\": 5.0"), std::string::npos) << results;
  EXPECT_NE(results.find("Fog goes by the distance from the eye."), std::string::npos) << results;
  EXPECT_NE(test::text_of(at("page.md")).find("## Homework 1: 5 of 9 points"), std::string::npos);
  test::write_text(at("rubric.json"), R"({"title": "Homework 1", "scenes": {"fog/other": {"points": 4}}})");
  const Outcome refused = plumb(run);
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(refused.says("expected scenes that are run, found fog/other")) << refused.text;
  EXPECT_EQ(plumb("check " + kSharedEdges + " --grade " + at("rubric.json")).code, 2) << "of a program";
}

// The kit guesses at no other format (CHANGELOG.md).
TEST_F(Cli, ExportOfAnotherVersionIsRefusedByTheKit) {
  ASSERT_EQ(plumb("export " + kSharedEdges + " " + at("export")).code, 0);
  const std::string manifest = test::text_of(at("export/manifest.json")), version = "\"version\": 1";
  const std::size_t place = manifest.find(version);
  ASSERT_NE(place, std::string::npos) << manifest;
  const std::string run = PLUMBLINE_C_RENDERER " " + at("export") + " " + at("out");
  for (const char* other : {"\"version\": 2", "\"version\": \"1\"", "\"v\": 1"}) {
    std::string changed = manifest;
    test::write_text(at("export/manifest.json"), changed.replace(place, version.size(), other));
    const Outcome refused = shell(run);
    EXPECT_EQ(refused.code, 1) << other;
    EXPECT_TRUE(refused.says("export: expected a plumbline export of version 1")) << refused.text;
  }
}

TEST_F(Cli, ExportWritesTheScene) {
  EXPECT_EQ(plumb("export " + kSharedEdges + " " + at("export")).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "export" / "meshes.0.positions.bin"));
  const Outcome again = plumb("export " + kScenes + "clip/crowd.json " + at("export"));
  EXPECT_EQ(again.code, 0) << again.text;
  test::write_text(folder_ / "export" / "mine.txt", "mine");
  const Outcome refused = plumb("export " + kSharedEdges + " " + at("export"));
  EXPECT_EQ(refused.code, 2) << refused.text;
  EXPECT_TRUE(refused.says("mine.txt")) << refused.text;
}

}  // namespace
}  // namespace plumbline

// plumb learn, and what is judged by the conventions that it writes.

#include <nlohmann/json.hpp>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

const std::string kLearnedProgram = " --program '" PLUMBLINE_C_RENDERER " {serve}'";

std::string declared(const std::string& more) {
  return R"({"format": "plumbline conventions", "version": 1, )" + more + "}";
}

TEST_F(Cli, LearnFindsAndWritesAProgramsConventions) {
  const Outcome run = plumb("learn" + kLearnedProgram + " -o " + at("c.json") + " --pictures " + at("pictures"));
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("subpixel_bits       8")) << run.text;
  EXPECT_TRUE(run.says("blending            open           blend")) << run.text;
  EXPECT_NE(test::text_of(at("c.json")).find("\"tie_rule\": \"left_bottom\""), std::string::npos);
  EXPECT_TRUE(fs::exists(at("pictures/grid_x.png")));
  const Outcome by = plumb("check " + kSharedEdges + kLearnedProgram + " --conventions " + at("c.json"));
  EXPECT_EQ(by.code, 0) << by.text;
  EXPECT_FALSE(by.says("owns a sample on an edge")) << by.text;
  const Outcome undeclared = plumb("check " + kSharedEdges + kLearnedProgram);
  EXPECT_EQ(undeclared.code, 0) << undeclared.text;
  EXPECT_TRUE(undeclared.says("not judged: which triangle owns a sample on an edge")) << undeclared.text;
  EXPECT_FALSE(undeclared.says("may be others than OpenGL's")) << "nothing is wrong\n" << undeclared.text;
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + kLearnedProgram + " --conventions " + at("c.json")).code, 0);
}

// A server that draws nothing new after its eighth probe.
TEST_F(Cli, LearnFindsThatAServerKeepsAState) {
  test::write_text(
      at("mine"),
      "#!/bin/sh\n"
      "kept=$TMPDIR/kept; n=0\n"
      "while IFS=\"$(printf '\\t')\" read -r in out; do\n" PLUMBLINE_C_RENDERER
      " \"$in\" \"$out\" 2>/dev/null || { echo unsupported; continue; }\n"
      "  n=$((n + 1)); color=planes.color.bin\n"
      "  [ $n != 8 ] || cp -r \"$out\" \"$kept\"\n"
      "  if [ $n -gt 8 ] && [ $(wc -c <\"$out/$color\") = $(wc -c <\"$kept/$color\") ]; then cp \"$kept/$color\" "
      "\"$out\"; fi\n"
      "  echo ok\n"
      "done\n");
  fs::permissions(at("mine"), fs::perms::owner_all);
  const Outcome run = plumb("learn --program '" + at("mine") + " {serve}'");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("probes are drawn otherwise when the program is started for each alone")) << run.text;
  EXPECT_FALSE(plumb("learn" + kLearnedProgram).says("drawn otherwise"));
}

// Drops all arrays but colour and depth from a capture's manifest.
void leave_the_frame(const std::string& path) {
  auto manifest = nlohmann::json::parse(test::text_of(path));
  std::erase_if(manifest.at("arrays").get_ref<nlohmann::json::array_t&>(), [](const nlohmann::json& array) {
    return array.at("name") != "planes.color" && array.at("name") != "planes.depth";
  });
  test::write_text(path, manifest.dump());
}

TEST_F(Cli, ADeclaredTieRuleIsJudgedByTheFrameAlone) {
  const std::string scene = kScenes + "coverage/on_centres.json";
  ASSERT_EQ(plumb("capture " + scene + " " + at("capture") + " --fault coverage.top_for_bottom").code, 0);
  leave_the_frame(at("capture/manifest.json"));
  const std::string by = "diagnose " + scene + " --against exact --capture " + at("capture");
  EXPECT_EQ(plumb(by).code, 0) << "any tie rule is legal";
  test::write_text(at("c.json"), declared(R"("tie_rule": "left_top")"));
  EXPECT_EQ(plumb(by + " --conventions " + at("c.json")).code, 0);
  test::write_text(at("c.json"), declared(R"("tie_rule": "left_bottom")"));
  const Outcome run = plumb(by + " --conventions " + at("c.json"));
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("coverage.top_for_bottom")) << run.text;
}

// Records too: exact makes their coverage by the dialect's rule.
TEST_F(Cli, ADeclaredTieRuleIsNoDifferenceOfTheRecords) {
  const std::string scene = kScenes + "coverage/on_centres.json";
  ASSERT_EQ(plumb("capture " + scene + " " + at("capture") + " --fault coverage.top_for_bottom").code, 0);
  const std::string by = "diagnose " + scene + " --against exact --capture " + at("capture") + " --conventions ";
  test::write_text(at("c.json"), declared(R"("tie_rule": "left_top")"));
  const Outcome right = plumb(by + at("c.json"));
  EXPECT_EQ(right.code, 0) << right.text;
  EXPECT_TRUE(right.says("wrong by itself: none\n")) << right.text;
  test::write_text(at("other.json"), declared(R"("tie_rule": "left_bottom")"));
  const Outcome other = plumb(by + at("other.json"));
  EXPECT_EQ(other.code, 1) << other.text;
  EXPECT_TRUE(other.says("wrong by itself: coverage")) << other.text;
}

TEST_F(Cli, AMistakenConventionIsOneFindingAndTheRestIsJudged) {
  // Our own picture, its rows turned over: declared, nothing else is wrong.
  ASSERT_EQ(plumb("capture " + kSharedEdges + " " + at("capture") + " --fault window.y_flipped").code, 0);
  leave_the_frame(at("capture/manifest.json"));
  const std::string by = "diagnose " + kSharedEdges + " --against exact --capture " + at("capture");
  EXPECT_EQ(plumb(by).code, 1);
  test::write_text(at("c.json"), declared(R"("rows": "from_top")"));
  const Outcome run = plumb(by + " --conventions " + at("c.json"));
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("rows: from_top, expected from_bottom")) << run.text;
  EXPECT_TRUE(run.says("first different stage: none")) << run.text;
}

TEST_F(Cli, AMistakenConventionOfASuiteEnds1WithOneLine) {
  test::write_text(at("c.json"), declared(R"("color_rounding": "down")"));
  const Outcome run = plumb("check " + kScenes + "cull" + kLearnedProgram + " --conventions " + at("c.json"));
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("convention color_rounding: down, expected nearest (how colours become codes)\n")) << run.text;
}

TEST_F(Cli, AMistakeThatIsAcceptedFailsNoRun) {
  test::write_text(at("c.json"), declared(R"("offset_unit": [0.5, 0.5], "accepted": ["offset_unit"])"));
  const std::string by = kLearnedProgram + " --conventions " + at("c.json");
  const Outcome check = plumb("check " + kScenes + "cull" + by);
  EXPECT_EQ(check.code, 0) << check.text;
  EXPECT_FALSE(check.says("convention offset_unit")) << check.text;
  EXPECT_TRUE(check.says("accepted by " + at("c.json") + ", if mistaken: offset_unit\n")) << check.text;
  EXPECT_EQ(plumb("diagnose " + kScenes + "cull/both_windings.json" + by).code, 0);
  test::write_text(at("c.json"), declared(R"("offset_unit": [0.5, 0.5], "accepted": ["rows"])"));
  EXPECT_EQ(plumb("check " + kScenes + "cull" + by).code, 1) << "another one is accepted";
  EXPECT_EQ(plumb("learn" + kLearnedProgram + " -o " + at("c.json")).code, 0);
  EXPECT_NE(test::text_of(at("c.json")).find(R"("accepted": ["rows"])"), std::string::npos) << "learn keeps the list";
  test::write_text(at("c.json"), declared(R"("accepted": ["colour_rounding"])"));
  const Outcome unknown = plumb("check " + kScenes + "cull" + by);
  EXPECT_EQ(unknown.code, 2);
  EXPECT_TRUE(unknown.says(at("c.json") + ": at \"/accepted/0\": expected the name of a convention")) << unknown.text;
}

TEST_F(Cli, AFailureIsRepeatedByTheConventionsToo) {
  test::write_text(at("c.json"), declared(R"("depth_range": "one_to_zero")"));
  const Outcome run = plumb("check " + kSharedEdges + kLearnedProgram + " --conventions " + at("c.json"));
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("repeat: ") && run.says("' --conventions " + at("c.json") + "\n")) << run.text;
  EXPECT_TRUE(run.says("may be others than those of " + at("c.json") + ":\n  plumb learn --program")) << run.text;
}

TEST_F(Cli, WhatLearnLeftUnexplainedIsAFindingOfCheckAndDiagnose) {
  test::write_text(at("c.json"), declared(R"("open": ["blending", "texture_bits", "tie_rule"], "texture_bits": 10,
                                  "unexplained": ["one scene drawn twice differs"])"));
  const std::string by = kLearnedProgram + " --conventions " + at("c.json");
  const Outcome check = plumb("check " + kScenes + "cull" + by);
  EXPECT_EQ(check.code, 1) << check.text;
  EXPECT_TRUE(check.says("no convention: one scene drawn twice differs\n")) << check.text;
  EXPECT_TRUE(check.says("the scenes hold: FAILED by conventions or expectations alone\n")) << check.text;
  EXPECT_FALSE(check.says("may be others than")) << "plumb learn wrote the file: " << check.text;
  EXPECT_TRUE(check.says("open in " + at("c.json") + ", and judged as OpenGL's: blending\n"))
      << "texture_bits has got a value, and of tie_rule another line tells: " << check.text;
  const Outcome diagnose = plumb("diagnose " + kSharedEdges + by);
  EXPECT_EQ(diagnose.code, 1) << diagnose.text;
  EXPECT_TRUE(diagnose.says("no convention: one scene drawn twice differs\n")) << diagnose.text;
  EXPECT_TRUE(diagnose.says("\nthe stages hold; FAILED by the mistakes in the conventions\n")) << diagnose.text;
}

TEST_F(Cli, ConventionsThatAreNoneAreRefused) {
  test::write_text(at("c.json"), declared(R"("rows": "sideways")"));
  const std::string with = " --conventions " + at("c.json");
  for (const std::string& line :
       {"check " + kSharedEdges + kLearnedProgram + with, "diagnose " + kSharedEdges + kLearnedProgram + with}) {
    const Outcome run = plumb(line);
    EXPECT_EQ(run.code, 2) << run.text;
    EXPECT_TRUE(run.says(at("c.json") + ": at \"/rows\": expected")) << run.text;
  }
  EXPECT_EQ(plumb("check " + kSharedEdges + with).code, 2) << "of nobody";
  EXPECT_EQ(plumb("diagnose " + kSharedEdges + with).code, 2) << "of nobody";
  EXPECT_EQ(plumb("check " + kSharedEdges + kLearnedProgram + " --conventions " + at("nothing.json")).code, 2);
}

TEST_F(Cli, LearnOfWhatDrawsNothingIsRefused) {
  const Outcome unable = plumb("learn --program 'sh -c \"echo no >&2; exit 77\" {input} {output}'");
  EXPECT_EQ(unable.code, 2) << unable.text;
  EXPECT_TRUE(unable.says("expected a rectangle of unlit triangles, found unsupported: no")) << unable.text;
  const Outcome failed = plumb("learn --program 'sh -c \"exit 3\" {input} {output}'");
  EXPECT_EQ(failed.code, 1) << failed.text;
  EXPECT_TRUE(failed.says("exited with status 3")) << failed.text;
  EXPECT_EQ(plumb("learn --program 'true'").code, 2) << "no {output}";
  EXPECT_EQ(plumb("learn --with nobody").code, 2);
  EXPECT_EQ(plumb("learn").code, 2) << "of whom";
  const Outcome slow = plumb("learn --time-limit 1 --program 'sh -c \"sleep 30\" {input} {output}'");
  EXPECT_EQ(slow.code, 1) << slow.text;
  EXPECT_TRUE(slow.says("took longer than 1s")) << slow.text;
  EXPECT_EQ(plumb("learn --with ours -o /nowhere/c.json").code, 2);
  const Outcome folder = plumb("learn --with ours --pictures /proc/pictures");
  EXPECT_EQ(folder.code, 2) << folder.text;
  EXPECT_TRUE(folder.says("--pictures: /proc/pictures: ") && !folder.says("evidence")) << folder.text;
}

}  // namespace
}  // namespace plumbline

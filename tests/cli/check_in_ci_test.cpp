// plumb check and plumb report as CI calls them.
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

const std::string kFault = " --against exact --fault depth.truncated";
class CheckInCi : public Cli {
 protected:
  std::string known(const std::string& scene, const std::string& expires) const {
    test::write_text(
        folder_ / "known.json",
        "{\"expectations\": [{\"scene\": \"" + scene +
            "\", \"reference\": \"exact\", \"kind\": \"per_stage\", \"stage\": \"depth\", \"reason\": \"a test\", "
            "\"issue\": \"none\", \"expires\": \"" +
            expires + "\"}]}");
    return " --expect " + at("known.json") + " --today 2026-05-05";
  }
};

TEST_F(CheckInCi, LeavesJunitMarkdownRowsAndAPageOfEachFailure) {
  ::unsetenv("CTEST_INTERACTIVE_DEBUG_MODE");
  const std::string outputs = " --junit " + at("j.xml") + " --markdown " + at("m.md") + " --rows " + at("rows") +
                              " --failures " + at("failures") + " --json " + at("c.json");
  Outcome run = plumb("check " + kSharedEdges + kFault + outputs);
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_TRUE(run.says("  report: " + at("failures/coverage/shared_edges/index.html"))) << run.text;
  EXPECT_FALSE(run.says("CTestMeasurementFile")) << "no ctest";
  EXPECT_TRUE(run.says("not asked: " + kOpenGl + ", embree"));
  EXPECT_TRUE(fs::exists(at("failures/coverage/shared_edges/index.html")));
  EXPECT_NE(test::text_of(at("j.xml")).find("failures=\"1\""), std::string::npos);
  EXPECT_NE(test::text_of(at("m.md")).find("| coverage/shared\\_edges | depth |"), std::string::npos)
      << test::text_of(at("m.md"));
  EXPECT_TRUE(test::text_of(at("rows/coverage/shared_edges.txt")).ends_with("\nFAILED\n"));

  run = shell("CTEST_INTERACTIVE_DEBUG_MODE=1 " PLUMBLINE_PLUMB " check " + kSharedEdges + kFault + outputs);
  const std::size_t tag = run.text.find("<CTestMeasurementFile type=\"image/png\" name=\"");
  ASSERT_NE(tag, std::string::npos) << run.text;
  const std::size_t from = run.text.find('>', tag) + 1;
  EXPECT_TRUE(fs::exists(run.text.substr(from, run.text.find('<', from) - from))) << "the picture is there";

  run = plumb("check " + kSharedEdges + " --against exact" + outputs);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(test::text_of(at("rows/coverage/shared_edges.txt")).ends_with("\nholds\n"));
  EXPECT_NE(test::text_of(at("j.xml")).find("failures=\"0\""), std::string::npos);
}

TEST_F(CheckInCi, FoldersThatCannotBeWrittenEndTheRunBeforeItBegins) {
  test::write_text(at("file"), "");
  for (const char* option : {" --rows ", " --failures "}) {
    const Outcome run = plumb("check " + kSharedEdges + " --against exact" + option + at("file/rows"));
    EXPECT_EQ(run.code, 2);
    EXPECT_TRUE(run.says(at("file") + " is not a folder")) << run.text;
    EXPECT_FALSE(run.says("shared_edges ")) << run.text;
  }
}

TEST_F(CheckInCi, ShardsComeToTheWholeRun) {
  const std::string scenes = kScenes + "cull " + kScenes + "merge";  // five scenes
  std::string shards;
  for (const char* i : {"1", "2"}) {
    const std::string json = at(std::string(i) + ".json");
    EXPECT_EQ(plumb("check " + scenes + " --against exact --shard " + i + "/2 --json " + json).code, 0);
    shards += " " + json;
  }
  EXPECT_EQ(plumb("check " + scenes + " --against exact --json " + at("whole.json")).code, 0);
  const Outcome merged = plumb("report merge" + shards + " -o " + at("all.json") + " --junit " + at("j.xml") +
                               " --markdown " + at("m.md"));
  EXPECT_EQ(merged.code, 0) << merged.text;
  EXPECT_TRUE(merged.says("5 scenes"));
  const Outcome diff = plumb("report diff " + at("whole.json") + " " + at("all.json") + " --slower 1000000");
  EXPECT_EQ(diff.code, 0);
  EXPECT_EQ(diff.text, "nothing has changed\n");
  EXPECT_EQ(plumb("report diff " + at("whole.json") + " " + at("1.json")).code, 1) << "a scene is not judged any more";
  const Outcome lacking = plumb("report merge " + at("2.json"));
  EXPECT_EQ(lacking.code, 1);
  EXPECT_TRUE(lacking.says("missing: shard 1 of 2")) << lacking.text;
  for (const char* bad : {"0/2", "3/2", "2", "1/2x", "a/b", "' 1/2'", "+1/2", "1/"}) {
    EXPECT_EQ(plumb("check " + scenes + " --shard " + bad).code, 2) << bad;
  }
  test::write_text(at("bad.json"), "{\"versions\": 1}");
  const Outcome bad = plumb("report diff " + at("whole.json") + " " + at("bad.json"));
  EXPECT_EQ(bad.code, 2);
  EXPECT_TRUE(bad.says("bad.json: expected a file of \"format\": \"plumbline run\"")) << bad.text;
  EXPECT_EQ(plumb("report").code, 2);
  EXPECT_EQ(plumb("report merge " + at("1.json") + " -o " + at("1.json")).code, 2) << "it is read by this run";
}

TEST_F(CheckInCi, WhatBreaksIsNamedByTheDiff) {
  EXPECT_EQ(plumb("check " + kSharedEdges + " --against exact --json " + at("old.json")).code, 0);
  EXPECT_EQ(plumb("check " + kSharedEdges + kFault + " --json " + at("new.json")).code, 1);
  const Outcome diff = plumb("report diff " + at("old.json") + " " + at("new.json") + " --json " + at("d.json") +
                             " --markdown " + at("d.md"));
  EXPECT_EQ(diff.code, 1);
  EXPECT_TRUE(diff.says("newly broken: ")) << diff.text;
  EXPECT_TRUE(diff.says("coverage/shared_edges, exact, per stage, depth: within -> different")) << diff.text;
  EXPECT_NE(test::text_of(at("d.json")).find("\"holds\": false"), std::string::npos);
  EXPECT_EQ(plumb("report diff " + at("new.json") + " " + at("old.json")).code, 0) << "fixed";
}

TEST_F(CheckInCi, ExpectationsExcuseWhatIsKnownUntilItExpiresOrPasses) {
  const std::string expect = known("coverage/shared_edges", "2026-05-05");
  Outcome run = plumb("check " + kSharedEdges + kFault + expect);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_TRUE(run.says("known to be different until 2026-05-05: a test (none)")) << run.text;
  EXPECT_TRUE(run.says("expectations: 1 occurred, 0 expired, 0 passed unexpectedly, 0 match nothing, 0 not asked"));

  run = plumb("check " + kSharedEdges + kFault + known("coverage/shared_edges", "2026-05-04"));
  EXPECT_EQ(run.code, 1);
  EXPECT_TRUE(run.says("expired coverage/shared_edges, exact, per stage, depth")) << run.text;
  run = plumb("check " + kSharedEdges + " --against exact" + expect);
  EXPECT_EQ(run.code, 1) << "it passes unexpectedly";
  EXPECT_TRUE(run.says("0 occurred, 0 expired, 1 passed unexpectedly")) << run.text;
  run = plumb("check " + kSharedEdges + " --against embree" + expect);
  EXPECT_TRUE(run.says("1 not asked")) << run.text;

  const std::string nowhere = known("coverage/no_such_scene", "2026-12-31");
  run = plumb("check " + kScenes + "cull" + " --against exact" + nowhere);
  EXPECT_EQ(run.code, 0) << "a part of the suite: not asked";
  run = plumb("check " + kScenes + "cull " + kScenes + "merge" + " --against exact" + nowhere);
  EXPECT_EQ(run.code, 1) << "folders of several groups: the suite";
  plumb("check " + kScenes + "cull --against exact --json " + at("cull.json") + nowhere);
  EXPECT_EQ(plumb("report merge " + at("cull.json") + " --suite " + kScenes + "cull").code, 0);
  Outcome merged =
      plumb("report merge " + at("cull.json") + " --suite " + kScenes + "cull --expect " + at("known.json"));
  EXPECT_EQ(merged.code, 1);
  EXPECT_TRUE(merged.says("expectation coverage/no_such_scene")) << merged.text;
  merged = plumb("report merge " + at("cull.json") + " --suite " + kScenes + "merge");
  EXPECT_EQ(merged.code, 1);
  EXPECT_TRUE(merged.says("missing: " + kScenes + "merge/")) << merged.text;
  plumb("report merge " + at("cull.json") + " --suite " + kScenes + "merge -o " + at("part.json"));
  EXPECT_EQ(plumb("report merge " + at("part.json")).code, 1) << "merged once more, it is not whole either";
  const std::string without = "report merge " + at("cull.json") + " --suite " + kScenes + "cull --without ";
  merged = plumb(without + "cull/both_windings");
  EXPECT_EQ(merged.code, 0) << merged.text;
  EXPECT_TRUE(merged.says("not run: cull/both_windings")) << merged.text;
  EXPECT_EQ(plumb(without + "cull/nothing").code, 2) << "no such scene";
  EXPECT_TRUE(run.says("expectation coverage/no_such_scene, exact, per stage, depth: there is no such scene"))
      << run.text;
  for (const char* bad : {"2026-02-30", "+026-02-20", "2026-2-201"}) {
    EXPECT_EQ(plumb("check " + kSharedEdges + " --today " + bad).code, 2) << bad;
  }
}

}  // namespace
}  // namespace plumbline

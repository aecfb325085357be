// Points by scene and stage.
#include "report/runs/grade.h"

#include <gtest/gtest.h>

#include "scene/json/json_tree.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::report {
namespace {

using check::Kind;
using check::Outcome;

check::Comparison graded_row(Stage stage, Outcome outcome) {
  return check::not_judged("clip/a", {"exact", Kind::from_scene}, stage, outcome, "12 pixels");
}
check::SceneVerdict graded_verdict(std::string scene, std::vector<check::Comparison> rows) {
  return {std::move(scene), "", std::move(rows)};
}

const SceneRubric kByStage{
    "clip/a", 10, {{Stage::coverage, 4}, {Stage::depth, 1}, {Stage::merge, 5}}, "Cut at the plane."};
const SceneRubric kWhole{"clip/a", 7, {}, ""};

TEST(Grade, AStageEarnsItsPointsWhereItWasJudgedAndIsRight) {
  const SceneGrade g = grade(kByStage, graded_verdict("clip/a", {graded_row(Stage::coverage, Outcome::ambiguous_only),
                                                                 graded_row(Stage::merge, Outcome::different)}));
  EXPECT_EQ(g.earned, 4);
  EXPECT_EQ(g.points, 10);
  EXPECT_EQ(g.text,
            "coverage (4 of 4): right\n"
            "depth (0 of 1): not judged: the program does not show it\n"
            "merge (0 of 5): wrong: 12 pixels\n"
            "Cut at the plane.\n");
  const SceneGrade all = grade(kByStage, graded_verdict("clip/a", {graded_row(Stage::coverage, Outcome::equal),
                                                                   graded_row(Stage::depth, Outcome::within),
                                                                   graded_row(Stage::merge, Outcome::equal)}));
  EXPECT_EQ(all.earned, 10);
  EXPECT_EQ(all.text.find("Cut"), std::string::npos) << "no hint where nothing is wrong";
}

TEST(Grade, AWholeSceneEarnsAllOrNothing) {
  EXPECT_EQ(grade(kWhole, graded_verdict("clip/a", {graded_row(Stage::merge, Outcome::within)})).earned, 7);
  EXPECT_EQ(grade(kWhole, graded_verdict("clip/a", {graded_row(Stage::merge, Outcome::different)})).earned, 0);
  EXPECT_EQ(grade(kWhole, graded_verdict("clip/a", {graded_row(Stage::merge, Outcome::unsupported)})).earned, 0);
  EXPECT_EQ(grade(kWhole, graded_verdict("clip/a", {graded_row(Stage::merge, Outcome::failed)})).earned, 0);
  EXPECT_EQ(grade(kWhole, graded_verdict("clip/a", {})).earned, 0);
}

// A known difference (--expect) is one; a row that failed says why the scene was not judged.
TEST(Grade, WhatIsKnownToBeWrongEarnsNothing) {
  const auto known = graded_verdict("clip/a", {graded_row(Stage::depth, Outcome::equal), [] {
                                                 check::Comparison c = graded_row(Stage::merge, Outcome::expected);
                                                 c.measurement.items = 12, c.measurement.differing = 3;
                                                 return c;
                                               }()});
  const SceneGrade whole = grade(kWhole, known), by_stage = grade({"clip/a", 5, {{Stage::merge, 5}}, ""}, known);
  EXPECT_EQ(whole.earned, 0);
  EXPECT_EQ(by_stage.earned, 0);
  EXPECT_TRUE(whole.text.starts_with("wrong, from the stage merge on: ")) << whole.text;
  EXPECT_TRUE(by_stage.text.starts_with("merge (0 of 5): wrong: ")) << by_stage.text;
  const SceneGrade failed = grade(kWhole, graded_verdict("clip/a", {graded_row(Stage::depth, Outcome::equal),
                                                                    graded_row(Stage::merge, Outcome::failed)}));
  EXPECT_EQ(failed.text, "not judged: 12 pixels\n");
  const SceneGrade lacking = grade(
      kWhole, graded_verdict(
                  "clip/a", {check::not_judged("clip/a", {"exact", Kind::from_scene}, Stage::depth, Outcome::equal, ""),
                             graded_row(Stage::merge, Outcome::expected)}));
  EXPECT_EQ(lacking.text, "not judged: 12 pixels\n");
}

TEST(Grade, ResultsAreGradescopesAndATable) {
  const Rubric rubric{"Homework 1", {kByStage, {"fog/b", 2, {}, ""}}};
  const std::vector verdicts = {graded_verdict("clip/a", {graded_row(Stage::coverage, Outcome::equal)}),
                                graded_verdict("fog/b", {graded_row(Stage::merge, Outcome::equal)})};
  EXPECT_TRUE(not_run(rubric, verdicts).empty());
  EXPECT_EQ(not_run(rubric, std::span(verdicts).first(1)), std::vector<std::string>{"fog/b"});
  const std::string json = gradescope_json(rubric, verdicts);
  for (const char* part : {"\"score\": 6.0,\n \"output\": \"Homework 1\"", "\"name\": \"clip/a\"",
                           "\"max_score\": 10.0", "\"status\": \"failed\"", "\"status\": \"passed\""}) {
    EXPECT_NE(json.find(part), std::string::npos) << part << json;
  }
  EXPECT_NE(grades_markdown(rubric, verdicts).find("## Homework 1: 6 of 12 points"), std::string::npos);
}

using GradeFile = TestFolder;

TEST_F(GradeFile, IsReadAndRefused) {
  const auto read_text = [&](const std::string& text) {
    test::write_text(root_ / "rubric.json", text);
    return read_rubric(root_ / "rubric.json");
  };
  const Rubric rubric = read_text(
      R"({"title": "H", "scenes": {"b/c": {"points":5}, "a/b": {"stages": {"depth": 2, "merge": 3.5}, "hint": "x"}}})");
  ASSERT_EQ(rubric.scenes.size(), 2u);
  EXPECT_EQ(rubric.scenes[0].points, 5.5);
  EXPECT_EQ(rubric.scenes[0].stages[1].first, Stage::merge);
  EXPECT_EQ(rubric.scenes[1].scene, "b/c");
  for (const char* bad :
       {R"({"title": "H", "scenes": {}})", R"({"title": "H"})", R"({"title": "H", "scenes": {"a/b": {}}})",
        R"({"title": "H", "scenes": {"a/b": {"points": -1}}})",
        R"({"title": "H", "scenes": {"a/b": {"stages": {"paint": 1}}}})",
        R"({"title": "H", "scenes": {"a/b": {"points": 1, "stages": {"depth": 1}}}})"}) {
    EXPECT_THROW(read_text(bad), JsonError) << bad;
  }
}

}  // namespace
}  // namespace plumbline::report

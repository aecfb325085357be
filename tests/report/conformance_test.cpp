// What another renderer can do, by feature.
#include "report/text/conformance.h"

#include <gtest/gtest.h>

namespace plumbline::report {
namespace {

using check::Comparison;
using check::Kind;
using check::Outcome;
using check::SceneVerdict;

Comparison row(const char* judge, Kind kind, Stage stage, Outcome outcome, std::string note = "") {
  Comparison out = check::not_judged("", {judge, kind}, stage, outcome, std::move(note));
  out.measurement.unit = "u";
  return out;
}
SceneVerdict verdict(std::string scene, std::vector<Comparison> rows) {
  return {std::move(scene), "", std::move(rows)};
}

const Comparison kHolds = row("exact", Kind::from_scene, Stage::merge, Outcome::within);
const Comparison kIllegal = row("exact", Kind::from_scene, Stage::depth, Outcome::different);
const Comparison kLegal = row("exact", Kind::from_scene, Stage::depth, Outcome::ambiguous_only);
const Comparison kBeside = row("osmesa", Kind::side_by_side, Stage::depth, Outcome::different);
const Comparison kUnable = row("program", Kind::side_by_side, Stage::merge, Outcome::unsupported, "fog");
const Comparison kCrash = row("program", Kind::side_by_side, Stage::merge, Outcome::failed, "crashed");
const Comparison kLacking = row("exact", Kind::from_scene, Stage::depth, Outcome::unsupported, "no plane");

TEST(Conformance, OfAScene) {
  EXPECT_EQ(conformance_of(verdict("a/b", {kHolds, kLacking})), Conformance::holds);
  EXPECT_EQ(conformance_of(verdict("a/b", {kHolds, kIllegal})), Conformance::differs);
  EXPECT_EQ(conformance_of(verdict("a/b", {kHolds, kBeside})), Conformance::differs);
  EXPECT_EQ(conformance_of(verdict("a/b", {kHolds, kBeside, kLegal})), Conformance::legal)
      << "the oracle calls it legal";
  EXPECT_EQ(conformance_of(verdict("a/b", {kUnable})), Conformance::unable);
  EXPECT_EQ(conformance_of(verdict("a/b", {kLacking})), Conformance::unable) << "what was not judged never passes";
  EXPECT_EQ(conformance_of(verdict("a/b", {})), Conformance::unable);
  EXPECT_EQ(conformance_of(verdict("a/b", {kCrash, kLacking})), Conformance::failed);
  Comparison open = row("exact", Kind::from_scene, Stage::merge, Outcome::ambiguous_only);
  open.measurement.items = open.measurement.ambiguous = 4;
  EXPECT_EQ(conformance_of(verdict("a/b", {open, kLacking})), Conformance::unable) << "an empty frame is legal, too";
  EXPECT_EQ(conformance_of(verdict("a/b", {open, kHolds})), Conformance::holds);
  const Comparison depth = row("exact", Kind::from_scene, Stage::depth, Outcome::within);
  EXPECT_EQ(conformance_of(verdict("a/b", {open, depth})), Conformance::unable) << "nobody judged a colour";
  EXPECT_TRUE(conformance_text(std::vector{verdict("a/b", {open})}).ends_with("several legal answers 1 (a/b)\n"));
  --open.measurement.ambiguous;
  EXPECT_EQ(conformance_of(verdict("a/b", {open})), Conformance::holds);
  SceneVerdict proves_nothing = verdict("a/b", {open, kLacking});
  proves_nothing.empty_holds = true;
  EXPECT_EQ(conformance_of(proves_nothing), Conformance::unable);
  EXPECT_TRUE(
      conformance_text(std::vector{proves_nothing}).ends_with("in which nothing is drawn holds, too 1 (a/b)\n"));
  SceneVerdict of_any_color = verdict("a/b", {open, depth});
  EXPECT_EQ(conformance_of(of_any_color), Conformance::holds);
  of_any_color.knows_no_color = true;
  EXPECT_EQ(conformance_of(of_any_color), Conformance::unable);
  proves_nothing.comparisons.push_back(kIllegal);
  EXPECT_EQ(conformance_of(proves_nothing), Conformance::differs);
  proves_nothing.comparisons = {open, kHolds};
  EXPECT_EQ(conformance_of(proves_nothing), Conformance::holds) << "a row proves something";
}

TEST(Conformance, TheFirstWrongStageIsTheOneThatIsWrongByItself) {
  const Comparison unseen = row("exact", Kind::from_scene, Stage::visibility, Outcome::different);
  const auto alone = [](Stage stage) { return row("exact", Kind::per_stage, stage, Outcome::different); };
  const auto first = [](std::vector<Comparison> rows) { return first_wrong(verdict("a/b", std::move(rows)))->stage; };
  EXPECT_EQ(first({kLegal, unseen}), Stage::visibility);
  EXPECT_EQ(first({kLegal, unseen, alone(Stage::depth)}), Stage::depth) << "its depths are not seen";
  const Comparison legal = row("exact", Kind::from_scene, Stage::coverage, Outcome::ambiguous_only);
  EXPECT_EQ(first({legal, unseen, alone(Stage::coverage)}), Stage::visibility) << "by another tie rule, perhaps";
  EXPECT_EQ(first_wrong(verdict("a/b", {kLegal, alone(Stage::depth)})), nullptr) << "nothing illegal comes of it";
  const Comparison unlike = row("exact", Kind::from_scene, Stage::merge, Outcome::different);
  for (const Stage stage : {Stage::attributes, Stage::texture, Stage::shade}) {
    const Comparison illegal = row("embree", Kind::legal, stage, Outcome::different);
    EXPECT_EQ(first_wrong(verdict("a/b", {alone(stage), kHolds})), nullptr) << "nor of its colours";
    EXPECT_EQ(first({alone(stage), unlike}), stage);
    EXPECT_EQ(first({alone(stage), illegal, kHolds}), stage);
    EXPECT_EQ(first({alone(stage)}), stage) << "nobody judged the frame";
    Comparison by_more = alone(stage);
    by_more.measurement.max_difference = 4096;
    EXPECT_EQ(first_wrong(verdict("a/b", {by_more, kHolds})), nullptr);
    by_more.measurement.max_difference = 4097;
    EXPECT_EQ(first({by_more, kHolds}), stage) << "more than stepping in float";
  }
  EXPECT_EQ(first({alone(Stage::clip), kHolds}), Stage::clip);
}

TEST(Conformance, OnlyWhatWasComparedIsRight) {
  const SceneVerdict of = verdict("a/b", {kHolds, kIllegal, kLegal, kLacking});
  EXPECT_TRUE(is_right(of, Stage::merge));
  EXPECT_FALSE(is_right(of, Stage::depth)) << "one row finds it wrong";
  EXPECT_FALSE(is_right(of, Stage::clip)) << "nobody judged it";
  EXPECT_FALSE(is_right(verdict("a/b", {kLegal}), Stage::depth)) << "what is open is not known";
}

TEST(Conformance, ColourOrDepthThatNobodyJudgedIsSaid) {
  const Comparison depth = row("exact", Kind::from_scene, Stage::depth, Outcome::within);
  const std::string none = "right or legal, and not judged";
  EXPECT_EQ(conformance_text(std::vector{verdict("a/b", {kHolds, depth})}).find(none), std::string::npos);
  EXPECT_TRUE(conformance_text(std::vector{verdict("a/b", {depth}), verdict("a/c", {depth}), verdict("a/d", {kHolds})})
                  .ends_with(none + ": colour 2, depth 1\n"));
  EXPECT_NE(conformance_markdown(std::vector{verdict("a/b", {depth})}).find(none + ": colour 1"), std::string::npos);
  EXPECT_EQ(conformance_text(std::vector{verdict("a/b", {kIllegal})}).find(none), std::string::npos) << "it is wrong";
}

TEST(Conformance, StagesThatAreWrongBesideTheFirstAreCounted) {
  const auto alone = [](Stage stage, Outcome outcome = Outcome::different) {
    return row("exact", Kind::per_stage, stage, outcome);
  };
  const std::string line = "wrong by itself beside the first wrong stage";
  const SceneVerdict two = verdict("a/b", {kIllegal, alone(Stage::depth), alone(Stage::shade)});
  EXPECT_NE(conformance_text(std::vector{two, two}).find(line + ": shade 2\n"), std::string::npos);
  EXPECT_NE(conformance_markdown(std::vector{two}).find(line + ": shade 1"), std::string::npos);
  for (const Comparison& other :
       {alone(Stage::shade, Outcome::within), row("embree", Kind::legal, Stage::merge, Outcome::different)}) {
    const std::string one = conformance_text(std::vector{verdict("a/b", {kIllegal, alone(Stage::depth), other})});
    EXPECT_EQ(one.find(line), std::string::npos) << "a later frame is wrong of it: " << one;
  }
  const SceneVerdict legal = verdict("a/b", {kIllegal, alone(Stage::depth), alone(Stage::shade), kHolds});
  EXPECT_EQ(conformance_text(std::vector{legal}).find(line), std::string::npos) << "its frame is legal";
}

TEST(Conformance, OfASuite) {
  std::vector<SceneVerdict> verdicts = {verdict("clip/a", {kHolds}), verdict("clip/b", {kIllegal}),
                                        verdict("fog/a", {kUnable}), verdict("fog/b", {kLacking}),
                                        verdict("fog/c", {kCrash}),  verdict("fog/d", {kUnable})};
  EXPECT_EQ(conformance_text(verdicts),
            "feature           right   legal   known   wrong  failed  unable  first wrong stage\n"
            "clip                  1       0       0       1       0       0  depth 1\n"
            "fog                   0       0       0       0       1       3  \n"
            "all                   1       0       0       1       1       3  depth 1\n"
            "unable: fog 2\n"
            "unable: nothing that it left could be judged 1 (fog/b)\n"
            "right or legal, and not judged: depth 1\n"
            "judged by the frame alone, wrong at the stage named or an earlier one: 1 (--each-primitive shows coverage "
            "and visibility)\n"
            "wrong, and no known fault matches: 1\n");
  const std::string markdown = conformance_markdown(verdicts);
  EXPECT_NE(markdown.find("| clip | 1 | 0 | 0 | 1 | 0 | 0 | depth 1 |\n"), std::string::npos) << markdown;
  for (const char* scene : {"clip/c", "clip/d"}) {
    verdicts.push_back(verdict(scene, {kIllegal}));
    verdicts.back().causes = {"window (fault window.y_flipped)"};
  }
  const std::string causes =
      "wrong as by window (fault window.y_flipped): 2, first clip/c\nwrong, and no known fault matches: 1\n";
  EXPECT_TRUE(conformance_text(verdicts).ends_with(causes)) << conformance_text(verdicts);
  EXPECT_EQ(whole_suite(verdicts).differs, 3u);
  SceneVerdict tied = verdict("clip/f", {kIllegal});
  tied.causes = {"clip (fault clip.of_one_scene)", "window (fault window.y_flipped)"};
  verdicts.insert(verdicts.begin(), tied);
  EXPECT_NE(conformance_text(verdicts).find("wrong as by window (fault window.y_flipped): 3, first clip/f\n"),
            std::string::npos)
      << "of causes that a frame does not tell apart that of the most scenes: " << conformance_text(verdicts);
  verdicts = {verdict("clip/g", {kIllegal})};
  verdicts.back().causes = tied.causes;
  EXPECT_NE(conformance_text(verdicts).find("wrong as by clip (fault clip.of_one_scene), or window (fault "
                                            "window.y_flipped): 1, first clip/g\n"),
            std::string::npos)
      << "equals are named together: " << conformance_text(verdicts);
  const Comparison record = row("exact", Kind::per_stage, Stage::window, Outcome::equal);
  const std::string by_records = conformance_text(std::vector{verdict("clip/e", {record, kIllegal})});
  EXPECT_EQ(by_records.find("by the frame alone"), std::string::npos) << by_records;
}

}  // namespace
}  // namespace plumbline::report

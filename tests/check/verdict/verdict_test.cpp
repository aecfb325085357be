// Outcomes, the first different stage, and the tolerance ledger.
#include "check/verdict/verdict.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>

#include "scene/json/json_file.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

Measurement measured(std::uint64_t differing, std::uint64_t disputed, std::uint64_t ambiguous, double difference) {
  Measurement m;
  m.items = 10;
  m.differing = differing;
  m.disputed = disputed;
  m.ambiguous = ambiguous;
  m.max_difference = difference;
  return m;
}
Outcome outcome(const Measurement& m) { return judged("s", "r", Stage::clip, m).outcome; }

TEST(Judged, EachOutcome) {
  EXPECT_EQ(outcome(measured(0, 0, 0, 0)), Outcome::equal);
  EXPECT_EQ(outcome(measured(0, 0, 0, 1e-300)), Outcome::within);
  EXPECT_EQ(outcome(measured(0, 0, 1, 0)), Outcome::ambiguous_only);
  EXPECT_EQ(outcome(measured(0, 0, 1, 3)), Outcome::ambiguous_only);
  EXPECT_EQ(outcome(measured(0, 1, 0, 0)), Outcome::dispute);
  EXPECT_EQ(outcome(measured(0, 1, 1, 3)), Outcome::dispute) << "a dispute is always listed";
  EXPECT_EQ(outcome(measured(1, 0, 0, 3)), Outcome::different);
  EXPECT_EQ(outcome(measured(1, 1, 1, 3)), Outcome::different) << "nothing excuses a difference";
  EXPECT_EQ(outcome(mismatch("u", "sizes", 0)), Outcome::different);
}

TEST(Judged, KeepsWhatItIsAbout) {
  const Comparison c =
      judged("scene", "ref", Stage::window, measured(1, 0, 0, 3), &tolerance(Profile::exact, Stage::window), "a note");
  EXPECT_EQ(c.scene, "scene");
  EXPECT_EQ(title_of(c.judge), "ref");
  EXPECT_EQ(c.stage, Stage::window);
  EXPECT_EQ(c.ledger_row, "exact.window");
  EXPECT_EQ(c.note, "a note");
  EXPECT_EQ(c.measurement.max_difference, 3);
  EXPECT_EQ(judged("s", "r", Stage::clip, mismatch("u", "3 against 4", 4)).note, "3 against 4");
  const std::string both = judged("s", "r", Stage::clip, mismatch("u", "3 against 4", 4), nullptr, "a note").note;
  EXPECT_NE(both.find("3 against 4"), std::string::npos);
}

TEST(Judged, ADisputeShowsItsOwnNumbers) {
  Measurement m = measured(0, 7, 0, 3);
  m.worst = {{1, 2, -1, "z"}, 5, 8, 3, 4};
  m.dispute = {{3, 4, -1, "color"}, 0.5, 0.75, 0.25, 0.125};
  m.reason = "it is late";
  const Comparison dispute = judged("s", "r", Stage::clip, m, nullptr, "a note");
  EXPECT_EQ(shown(dispute)->difference, 0.25);
  EXPECT_EQ(remark(dispute), "pixel 3,4 color; 0.5, the reference 0.75; 7 disputed: it is late; a note");
  const Comparison within = judged("s", "r", Stage::clip, measured(0, 0, 0, 3), nullptr, "a note");
  EXPECT_EQ(shown(within)->difference, 0) << "of the worst, which is not given here";
  EXPECT_EQ(remark(within), "a note");
  EXPECT_EQ(shown(judged("s", "r", Stage::clip, measured(0, 0, 0, 0))), nullptr);
}

TEST(Judged, NotJudgedSaysWhy) {
  const Comparison c = not_judged("scene", "ref", Stage::merge, Outcome::missing, "not built in");
  EXPECT_EQ(c.outcome, Outcome::missing);
  EXPECT_EQ(c.note, "not built in");
  EXPECT_EQ(c.measurement.items, 0u);
}

TEST(Outcomes, NamesAndFailures) {
  const std::vector<std::pair<Outcome, std::string>> names = {
      {Outcome::equal, "equal"},         {Outcome::within, "within"},   {Outcome::ambiguous_only, "ambiguous_only"},
      {Outcome::different, "different"}, {Outcome::dispute, "dispute"}, {Outcome::unsupported, "unsupported"},
      {Outcome::missing, "missing"},     {Outcome::failed, "failed"}};
  for (const auto& [value, name] : names) {
    EXPECT_EQ(name_of(value), name);
    EXPECT_EQ(is_failure(value), name == "different" || name == "missing" || name == "failed") << name;
  }
}

TEST(FirstDifferent, IsTheFirstStageNotTheFirstListed) {
  const Measurement bad = measured(1, 0, 0, 3), good = measured(0, 0, 0, 0);
  SceneVerdict verdict;
  EXPECT_EQ(first_different(verdict), nullptr);
  verdict.comparisons = {judged("s", "a", Stage::matrices, good),
                         judged("s", "a", Stage::merge, bad),
                         judged("s", "a", Stage::coverage, bad),
                         judged("s", "b", Stage::coverage, bad),
                         judged("s", "b", Stage::vertex, measured(0, 1, 0, 0)),
                         not_judged("s", "c", Stage::matrices, Outcome::failed, ""),
                         not_judged("s", "c", Stage::matrices, Outcome::missing, "")};
  EXPECT_EQ(first_different(verdict), &verdict.comparisons[2]) << "of several at one stage, the first listed";
  verdict.comparisons[4] = judged("s", "b", Stage::vertex, bad);
  EXPECT_EQ(first_different(verdict), &verdict.comparisons[4]);
  verdict.comparisons.resize(1);
  EXPECT_EQ(first_different(verdict), nullptr);
}

// The depths of the frame are the winners': a wrong test of depths shows in them.
TEST(FirstDifferent, IsTheStageThatIsWrongAloneWhereThatOfThePlanesHolds) {
  const Measurement bad = measured(1, 0, 0, 3), good = measured(0, 0, 0, 0);
  const JudgeId alone("exact", Kind::per_stage);
  SceneVerdict verdict;
  verdict.comparisons = {judged("s", "osmesa", Stage::depth, bad), judged("s", alone, Stage::depth, good),
                         judged("s", alone, Stage::merge, bad), judged("s", alone, Stage::visibility, bad)};
  EXPECT_EQ(first_different(verdict), &verdict.comparisons[3]);
  EXPECT_TRUE(holds_alone(verdict, Stage::depth));
  verdict.comparisons[1] = judged("s", alone, Stage::depth, bad);
  EXPECT_EQ(first_different(verdict), &verdict.comparisons[1]) << "depth is wrong alone";
  EXPECT_FALSE(holds_alone(verdict, Stage::depth));
  verdict.comparisons[1] = not_judged("s", alone, Stage::depth, Outcome::unsupported, "");
  EXPECT_EQ(first_different(verdict), &verdict.comparisons[0]) << "nobody judged depth alone";
  verdict.comparisons[1] = judged("s", {"exact", Kind::from_scene}, Stage::depth, good);
  EXPECT_EQ(first_different(verdict), &verdict.comparisons[0]) << "who holds judged no records";
  verdict.comparisons = {judged("s", "osmesa", Stage::depth, bad), judged("s", alone, Stage::depth, good),
                         judged("s", "osmesa", Stage::merge, bad)};
  EXPECT_EQ(first_different(verdict), &verdict.comparisons[0]) << "no stage is wrong alone";
}

TEST(DiffersBySteps, UpToARoundingForEachStep) {
  const JudgeId alone("exact", Kind::per_stage);
  const auto row = [&](Stage stage, double u) {
    Measurement m = measured(u > 0 ? 1 : 0, 0, 0, u);
    m.unit = "u";
    return judged("s", alone, stage, m);
  };
  SceneVerdict verdict;
  verdict.comparisons = {judged("s", JudgeId("exact", Kind::legal), Stage::attributes, measured(1, 0, 0, 2))};
  EXPECT_FALSE(differs_by_steps(verdict, Stage::attributes)) << "of twice a bound, which is no number of roundings";
  verdict.comparisons = {row(Stage::attributes, 4096), row(Stage::shade, 0), row(Stage::merge, 2)};
  EXPECT_TRUE(differs_by_steps(verdict, Stage::attributes));
  EXPECT_FALSE(differs_by_steps(verdict, Stage::shade)) << "equal";
  EXPECT_FALSE(differs_by_steps(verdict, Stage::merge)) << "codes are not stepped";
  EXPECT_EQ(first_beyond_steps(verdict), &verdict.comparisons[2]);
  verdict.comparisons[0] = row(Stage::attributes, 4097);
  EXPECT_FALSE(differs_by_steps(verdict, Stage::attributes));
  EXPECT_EQ(first_beyond_steps(verdict), &verdict.comparisons[0]);
  verdict.comparisons[0] = row(Stage::attributes, std::nan(""));
  EXPECT_FALSE(differs_by_steps(verdict, Stage::attributes));
  verdict.comparisons = {row(Stage::attributes, 100)};
  EXPECT_EQ(first_beyond_steps(verdict), nullptr);
}

Comparison declined(Stage stage) { return not_judged("s", "a", stage, Outcome::unsupported, "why"); }
Comparison compared(Stage stage, std::uint64_t differing = 0) {
  return judged("s", "b", stage, measured(differing, 0, 0, static_cast<double>(differing)));
}

TEST(UnjudgedStages, AreThoseThatNobodyComparedOrAllDeclined) {
  SceneVerdict verdict;
  for (Stage stage : {Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::coverage, Stage::attributes,
                      Stage::shade, Stage::visibility}) {
    verdict.comparisons.push_back(declined(stage));
    verdict.comparisons.push_back(compared(stage, stage == Stage::clip ? 1 : 0));
  }
  verdict.comparisons.push_back(declined(Stage::window));
  verdict.comparisons.push_back(declined(Stage::window));
  EXPECT_EQ(unjudged_stages(verdict), (std::vector{Stage::window, Stage::depth, Stage::merge})) << "depth has no row";
  for (Outcome outcome : {Outcome::missing, Outcome::failed}) {
    verdict.comparisons.push_back(not_judged("s", "c", Stage::merge, outcome, ""));
    EXPECT_EQ(unjudged_stages(verdict), (std::vector{Stage::window, Stage::depth, Stage::merge}))
        << "who is missing or failed judged nothing";
  }
  verdict.comparisons.clear();
  EXPECT_EQ(unjudged_stages(verdict).size(), kStageNames.size() - 2)
      << "all but texture and resolve, of which nobody said anything";
}

TEST(UnjudgedStages, AreLostToAMissingReferenceWhereNobodyElseDeclined) {
  SceneVerdict verdict;
  verdict.comparisons = {declined(Stage::depth), compared(Stage::vertex), compared(Stage::merge)};
  EXPECT_TRUE(stages_lost_to_missing(verdict).empty()) << "none is missing: nothing is forgiven";
  verdict.comparisons.push_back(not_judged("s", "c", Stage::merge, Outcome::missing, "not built in"));
  const std::vector<Stage> lost = stages_lost_to_missing(verdict);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    const bool judged_or_declined = stage == Stage::depth || stage == Stage::vertex || stage == Stage::merge;
    const bool of_some_scenes = stage == Stage::texture || stage == Stage::resolve;
    EXPECT_EQ(std::ranges::count(lost, stage), judged_or_declined || of_some_scenes ? 0 : 1) << name_of(stage);
  }
}

TEST(Ledger, RowsAreUniqueAndSayWhy) {
  std::set<std::string> names;
  for (const Tolerance& row : ledger()) {
    const std::string name = name_of(row);
    EXPECT_TRUE(names.insert(name).second) << name << " stands twice";
    EXPECT_GT(row.factor, 0) << name << ": what is zero is not here";
    EXPECT_TRUE(std::isfinite(row.factor)) << name;
    EXPECT_FALSE(row.unit.empty()) << name;
    EXPECT_GT(row.derivation.size(), 20u) << name;
    EXPECT_EQ(&tolerance(row.profile, row.stage, row.part), &row);
  }
  EXPECT_FALSE(names.empty());
  EXPECT_THROW(tolerance(Profile::exact, Stage::vertex, "nothing"), std::logic_error);
  EXPECT_THROW(tolerance(Profile::foreign, Stage::vertex), std::logic_error) << "nobody is judged as another";
}

// golden/tolerances.json is the suite's use of the ledger.
TEST(Ledger, EachRowIsUsedByTheSuite) {
  const JsonFile file(PLUMBLINE_SOURCE_DIR "/golden/tolerances.json");
  std::set<std::string> used, rows;
  for (const JsonNode& row : file.root()["tolerances"].elements(0, 1000)) {
    EXPECT_NE(row["largest_seen"].value().kind, JsonValue::Kind::null) << row["name"].text();
    used.insert(row["name"].text());
  }
  for (const Tolerance& row : ledger()) rows.insert(name_of(row));
  EXPECT_EQ(used, rows);
}

TEST(LedgerUse, KeepsTheLargestRatioOfEachRow) {
  const Tolerance* const clip = &tolerance(Profile::exact, Stage::clip);
  const Tolerance* const light = &tolerance(Profile::exact, Stage::light);
  const auto compared = [](double ratio, std::int64_t record, const Tolerance* row) {
    Measurement m = measured(0, 0, 0, ratio);
    m.max_ratio = ratio;
    m.worst.place.record = record;
    return judged("scene" + std::to_string(record), "ref", Stage::clip, m, row);
  };
  std::vector<SceneVerdict> verdicts(2);
  verdicts[0].comparisons = {compared(0.25, 1, clip), compared(0.75, 2, clip), compared(9, 3, nullptr)};
  verdicts[1].comparisons = {compared(0.5, 4, clip), compared(0, 5, light)};
  verdicts[1].comparisons.push_back(compared(0.9, 6, clip));
  verdicts[1].comparisons.back().outcome = Outcome::dispute;  // of which nobody knows what is the tolerance's
  std::size_t seen = 0;
  for (const LedgerUse& use : ledger_use(verdicts)) {
    ++seen;
    if (use.row == clip) {
      EXPECT_EQ(use.largest_ratio, 0.75);
      EXPECT_EQ(use.where, "scene2, ref, record 2");
    } else if (use.row == light) {
      EXPECT_EQ(use.largest_ratio, 0) << "used, though nothing was apart";
    } else {
      EXPECT_LT(use.largest_ratio, 0) << name_of(*use.row) << " was not used";
    }
  }
  EXPECT_EQ(seen, ledger().size());
}

}  // namespace
}  // namespace plumbline::check

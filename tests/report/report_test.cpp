// Reports: what a person or a program reads of a verdict.
#include <filesystem>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_path.h"
#include "report/runs/json_report.h"
#include "report/text/diagnosis_text.h"
#include "report/text/safe_text.h"
#include "report/text/table.h"
#include "tests/check/fixtures.h"
#include "tests/check/verdict/verdicts.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::report {
namespace {

namespace fs = std::filesystem;
using check::Comparison;
using check::kInf;
using check::kNaN;
using check::Measurement;
using check::Outcome;
using check::SceneVerdict;

struct Reports : TestFolder {
  static std::size_t entries(const fs::path& of) {
    return static_cast<std::size_t>(std::distance(fs::recursive_directory_iterator(of), {}));
  }
  nlohmann::json json(const std::vector<SceneVerdict>& verdicts) const {
    write_json(folder / "out.json", verdicts, {{{"ours", "0.1"}, {"osmesa", "Mesa \"22\""}}, "", {}, false, {}, {}});
    return nlohmann::json::parse(test::text_of(folder / "out.json"));
  }
  const fs::path& folder = root_;
};

TEST_F(Reports, ATableRowSaysAll) {
  const std::string rows = table_rows(verdict_of({compared(Outcome::different, 3.5, 8)}));
  for (const char* part : {"group/scene ", "osmesa ", "clip ", "different ", " 1536 ", " 17 ", " 0 ",
                           "3.5 u (tolerance 8)", "pixel 12,34 record 56 p_clip"}) {
    EXPECT_TRUE(contains(rows, part)) << part << " in " << rows;
  }
  EXPECT_TRUE(contains(table_rows(verdict_of({compared(Outcome::ambiguous_only)})), " 5 "));
  EXPECT_TRUE(contains(table_rows(verdict_of({compared(Outcome::different, 102.5, 0x1p-126)})),
                       "102.5 u (tolerance underflow)"));
  EXPECT_TRUE(contains(table_rows(verdict_of({compared(Outcome::different, 1, 0)})), "1 u (tolerance 0)"));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1);
  for (const char* part : {"scene", "reference", "stage", "outcome", "pixels", "differing", "ambiguous"}) {
    EXPECT_TRUE(contains(table_head(), part)) << part;
  }
}

TEST_F(Reports, ADiagnosisNamesStagesThatFailed) {
  check::Diagnosis none;
  none.verdict = verdict_of({compared(Outcome::equal)});
  EXPECT_TRUE(contains(diagnosis_text(none), "first different stage: none\n"));
  Comparison failed = not_compared(Outcome::failed, "window.p_win: 1 of 3 corners are not finite");
  failed.stage = Stage::window;
  none.verdict = verdict_of({compared(Outcome::equal), failed, failed});
  EXPECT_TRUE(contains(diagnosis_text(none), "first different stage: none; failed: window\n"));
}

// Ties are no excuse where a judge of legal answers finds the frame wrong.
TEST_F(Reports, ADiagnosisCallsNoFrameLegalThatIsNot) {
  check::Diagnosis of;
  of.first = Stage::merge;
  Comparison alone = compared(Outcome::different, 3, 1), legal = compared(Outcome::within, 1, 8), depth = legal;
  alone.stage = legal.stage = Stage::merge, depth.stage = Stage::depth;
  alone.judge = {"exact", check::Kind::per_stage};
  legal.judge = depth.judge = {"exact", check::Kind::from_scene};
  of.verdict = verdict_of({alone, legal, depth});
  EXPECT_TRUE(contains(diagnosis_text(of), "the frame is legal"));
  of.verdict.comparisons[2].outcome = Outcome::different;
  EXPECT_FALSE(contains(diagnosis_text(of), "the frame is legal")) << "its depths are not";
}

TEST_F(Reports, ASceneThatHoldsIsALine) {
  const Comparison unsupported = not_compared(Outcome::unsupported, "because of this");
  EXPECT_EQ(scene_line(verdict_of({compared(Outcome::equal), compared(Outcome::within, 1, 8), unsupported})),
            "group/scene                  holds: 1 equal, 1 within, 1 unsupported\n");
  EXPECT_EQ(scene_line(verdict_of({unsupported})), "group/scene                  not judged: 1 unsupported\n");
}

TEST_F(Reports, ARowOfWhatWasNotJudgedShowsNoNumbersButTheReason) {
  for (Outcome outcome : {Outcome::unsupported, Outcome::missing, Outcome::failed}) {
    const std::string row = table_rows(verdict_of({not_compared(outcome, "because of this")}));
    EXPECT_TRUE(contains(row, std::string(name_of(outcome))));
    EXPECT_TRUE(contains(row, "because of this"));
    EXPECT_FALSE(contains(row, " 0")) << "not judged is not zero differences: " << row;
  }
}

TEST_F(Reports, StagesThatAReferenceDoesNotJudgeForOneReasonAreOneRow) {
  const auto row = [](Stage stage, const char* note, Outcome outcome = Outcome::unsupported) {
    Comparison out = not_compared(outcome, note);
    out.stage = stage;
    return out;
  };
  Comparison judged = compared(Outcome::equal), others = row(Stage::window, "no plane");
  judged.stage = Stage::depth;
  others.judge.reference = "another";
  const std::string rows = table_rows(
      verdict_of({row(Stage::vertex, "no plane"), row(Stage::clip, "no record"), judged,
                  row(Stage::window, "no plane\nand more"), others, row(Stage::shade, "no plane", Outcome::failed)}));
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 5) << rows;
  EXPECT_TRUE(contains(rows, "2 stages   unsupported")) << rows;
  EXPECT_TRUE(contains(rows, "vertex, window (no plane)\n")) << rows;
  EXPECT_TRUE(contains(rows, "clip       unsupported")) << rows;
  EXPECT_TRUE(contains(rows, "no record\n")) << rows;
  EXPECT_TRUE(contains(rows, "shade      failed")) << rows;
  EXPECT_TRUE(contains(rows, "window     unsupported")) << "the other reference's: " << rows;
}

TEST_F(Reports, EqualShowsNoPlace) {
  const std::string row = table_rows(verdict_of({compared(Outcome::equal)}));
  EXPECT_FALSE(contains(row, "pixel 12,34"));
  EXPECT_TRUE(contains(row, " 0 "));
  Comparison noted = compared(Outcome::within, 2, 8);
  noted.note = "a note";
  EXPECT_TRUE(contains(table_rows(verdict_of({noted})), "pixel 12,34 record 56 p_clip; a note"));
}

TEST_F(Reports, FailuresNameStagePlaceNumbersAndCommand) {
  Comparison first = compared(Outcome::different, 4, 1), later = compared(Outcome::different, 9, 1);
  later.stage = Stage::merge;
  const std::string lines = failure_lines(verdict_of({later, first}), {}, "plumb check 'a b.json'");
  for (const char* part : {"group/scene", "first different stage: clip", "osmesa", "17 of 1536", "pixel 12,34", "0.5",
                           "0.25", "4 u apart", "tolerance 1", "repeat: plumb check 'a b.json'"}) {
    EXPECT_TRUE(contains(lines, part)) << part << " in " << lines;
  }
  EXPECT_FALSE(contains(lines, "merge"));
  EXPECT_FALSE(contains(lines, "an earlier one"));
  EXPECT_TRUE(
      contains(failure_lines(verdict_of({later}), {}, "again"), "merge (against osmesa), or an earlier one: 17"));
  later.judge = check::JudgeId("exact", check::Kind::per_stage);
  EXPECT_TRUE(contains(failure_lines(verdict_of({later, first}), {}, "again"), "wrong by themselves: merge"));
  later.outcome = Outcome::within;
  EXPECT_FALSE(contains(failure_lines(verdict_of({later, first}), {}, "again"), "too"));
  EXPECT_EQ(failure_lines(verdict_of({compared(Outcome::equal), compared(Outcome::within, 1, 2),
                                      compared(Outcome::ambiguous_only), compared(Outcome::dispute)}),
                          {}, "repeat"),
            "");
  const std::string unjudged = failure_lines(verdict_of({}), std::vector{Stage::light}, "again");
  EXPECT_TRUE(contains(unjudged, "no reference judged light")) << unjudged;
  EXPECT_TRUE(contains(unjudged, "repeat: again")) << unjudged;
  for (Outcome outcome : {Outcome::missing, Outcome::failed}) {
    const std::string why = failure_lines(verdict_of({not_compared(outcome, "no such thing")}), {}, "again");
    EXPECT_TRUE(contains(why, "embree, light: no such thing")) << why;
    EXPECT_TRUE(contains(why, "repeat: again"));
  }
}

TEST_F(Reports, SummaryIsOkOnlyWhereAllWasJudged) {
  const auto of = [](std::vector<Comparison> c, bool all_hold) {
    return summary(std::vector{verdict_of(std::move(c))}, all_hold, 1.5);
  };
  std::vector<Comparison> all;  // each stage, by somebody
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    if (static_cast<Stage>(i) == Stage::texture) continue;
    all.push_back(i == 2 ? compared(Outcome::within, 1, 2)
                         : compared(i == 3 ? Outcome::ambiguous_only : Outcome::equal));
    all.back().stage = static_cast<Stage>(i);
  }
  const std::string fine = of(all, true);
  const std::string expected = fmt::format(
      "ok: 1 scenes, {} comparisons in 1.50 s: {} equal, 1 within, 1 ambiguous_only", all.size(), all.size() - 2);
  EXPECT_TRUE(fine.starts_with(expected)) << fine;
  EXPECT_TRUE(of(all, false).starts_with("FAILED"));
  for (Outcome outcome : {Outcome::unsupported, Outcome::dispute, Outcome::missing}) {
    std::vector<Comparison> more = all;
    more.push_back(not_compared(outcome, ""));
    const std::string text = of(more, true);
    EXPECT_TRUE(text.starts_with("ok where judged:")) << "a bare ok: " << text;
    EXPECT_TRUE(contains(text, "1 " + std::string(name_of(outcome)))) << text;
    EXPECT_TRUE(of(more, false).starts_with("FAILED")) << "--allow-missing was not given, or a stage is unjudged";
  }
  std::erase_if(all, [](const Comparison& c) { return c.stage == Stage::merge; });
  EXPECT_TRUE(of(all, true).starts_with("ok where judged:")) << "nobody compared merge";
}

TEST_F(Reports, EachGroupHasALineOfItsScenesAndOutcomes) {
  std::vector<SceneVerdict> verdicts{verdict_of({compared(Outcome::equal), compared(Outcome::within, 1, 2)}),
                                     verdict_of({compared(Outcome::equal), not_compared(Outcome::unsupported, "")}),
                                     verdict_of({compared(Outcome::different, 1)}), verdict_of({})};
  verdicts[0].scene = "depth/near";
  verdicts[1].scene = "depth/far";
  verdicts[2].scene = "clip/near/left";
  verdicts[3].scene = "alone";
  EXPECT_EQ(group_lines(verdicts),
            "alone               1 scenes      0 comparisons: \n"
            "clip                1 scenes      1 comparisons: 1 different\n"
            "depth               2 scenes      4 comparisons: 2 equal, 1 within, 1 unsupported\n");
  EXPECT_EQ(group_lines({}), "");
}

TEST_F(Reports, ASummaryOfNothingIsNotOk) {
  EXPECT_FALSE(summary({}, true, 0).starts_with("ok")) << summary({}, true, 0);
  EXPECT_FALSE(summary(std::vector{verdict_of({})}, true, 0).starts_with("ok")) << "nothing was compared for a scene";
  Comparison picture = compared(Outcome::equal);
  picture.judge = {"picture", check::Kind::picture};
  const std::string repeated =
      summary(std::vector{verdict_of({not_compared(Outcome::unsupported, ""), picture})}, true, 0);
  EXPECT_TRUE(repeated.starts_with("nothing was judged: ")) << "the frame repeats the candidate: " << repeated;
  Comparison excused = not_compared(Outcome::missing, "");
  excused.outcome = Outcome::expected;
  EXPECT_TRUE(summary(std::vector{verdict_of({excused})}, true, 0).starts_with("nothing was judged: "));
  SceneVerdict open = verdict_of({compared(Outcome::ambiguous_only, 1, 1)});
  EXPECT_TRUE(summary(std::vector{open}, true, 0).starts_with("ok")) << "some pixels have one legal answer";
  EXPECT_NE(scene_line(open).find(" holds: "), std::string::npos) << scene_line(open);
  open.empty_holds = true;
  EXPECT_TRUE(summary(std::vector{open}, true, 0).starts_with("nothing was judged: ")) << "the cleared frame holds";
  EXPECT_NE(scene_line(open).find(" not judged: "), std::string::npos) << scene_line(open);
}

TEST_F(Reports, JsonHasAllKeys) {
  const auto out = json({verdict_of({compared(Outcome::different, 3.5, 8)})});
  EXPECT_EQ(out["versions"]["osmesa"], "Mesa \"22\"");
  ASSERT_EQ(out["comparisons"].size(), 1u);
  const auto& c = out["comparisons"][0];
  EXPECT_EQ(c["scene"], "group/scene");
  EXPECT_EQ(c["reference"], "osmesa");
  EXPECT_EQ(c["stage"], "clip");
  EXPECT_EQ(c["outcome"], "different");
  EXPECT_EQ(c["pixels"], 1536);
  EXPECT_EQ(c["differing"], 17);
  EXPECT_EQ(c["ambiguous"], 0);
  EXPECT_EQ(c["max_difference"], 3.5);
  EXPECT_EQ(c["unit"], "u");
  EXPECT_EQ(c["worst"]["tolerance"], 8);
  EXPECT_EQ(c["worst"]["place"], "pixel 12,34 record 56 p_clip");
  EXPECT_EQ(c["worst"]["pixel"], nlohmann::json({12, 34}));
  EXPECT_EQ(c["worst"]["candidate"], 0.5);
  EXPECT_EQ(c["worst"]["reference"], 0.25);
  EXPECT_EQ(c["histogram"].size(), 20u);
  EXPECT_EQ(c["ledger"], "exact.clip");
  EXPECT_EQ(out["scenes"][0]["file"], "scenes/group/scene.json");
}

TEST_F(Reports, JsonHasAnObjectPerComparison) {
  const auto out = json({verdict_of({compared(Outcome::equal), not_compared(Outcome::missing, "not built in")}),
                         verdict_of({compared(Outcome::within, 1, 2)})});
  ASSERT_EQ(out["comparisons"].size(), 3u);
  EXPECT_EQ(out["scenes"].size(), 2u);
  EXPECT_TRUE(out["comparisons"][0]["worst"].is_null());
  EXPECT_EQ(out["comparisons"][1]["outcome"], "missing");
  EXPECT_EQ(out["comparisons"][1]["note"], "not built in");
  for (const auto& c : out["comparisons"]) {
    for (const char* key : {"scene", "reference", "stage", "outcome", "pixels", "differing", "ambiguous",
                            "max_difference", "unit", "worst"}) {
      EXPECT_TRUE(c.contains(key)) << key;
    }
  }
  const auto nothing = json({});
  EXPECT_TRUE(nothing["comparisons"].is_array());
  EXPECT_EQ(nothing["comparisons"].size(), 0u);
}

TEST_F(Reports, JsonOfWhatIsNoNumberStillParses) {
  Comparison c = compared(Outcome::different, kInf, 0);
  c.measurement.worst.candidate = kNaN;
  c.measurement.worst.reference = -kInf;
  const auto out = json({verdict_of({c})})["comparisons"][0];
  EXPECT_EQ(out["max_difference"], "inf");
  EXPECT_EQ(out["max_ratio"], "inf");
  EXPECT_EQ(out["worst"]["difference"], "inf");
  EXPECT_EQ(out["worst"]["candidate"], "nan");
  EXPECT_EQ(out["worst"]["reference"], "-inf");
}

TEST_F(Reports, JsonOfAnyTextStillParses) {
  const std::string odd = "quote \" backslash \\ newline \n tab \t bell \a umlaut \xc3\xa4";
  EXPECT_EQ(json({verdict_of({not_compared(Outcome::failed, odd)})})["comparisons"][0]["note"], odd);
  const auto broken = json({verdict_of({not_compared(Outcome::failed, "no UTF-8: \xff\xfe")})});
  EXPECT_TRUE(contains(broken["comparisons"][0]["note"].get<std::string>(), "no UTF-8: "));
}

TEST_F(Reports, LedgerFileHasEveryRow) {
  Comparison c = compared(Outcome::within, 1.234, 8);
  c.measurement.max_ratio = 0.15425;
  write_ledger(folder / "ledger.json", std::vector{verdict_of({c})});
  const auto out = nlohmann::json::parse(test::text_of(folder / "ledger.json"));
  ASSERT_EQ(out["tolerances"].size(), check::ledger().size());
  for (std::size_t i = 0; i < check::ledger().size(); ++i) {
    const auto& row = out["tolerances"][i];
    EXPECT_EQ(row["name"], name_of(check::ledger()[i]));
    if (row["name"] == "exact.clip") {
      EXPECT_EQ(row["largest_seen"], 0.15);
      EXPECT_TRUE(contains(row["where"], "group/scene"));
    } else {
      EXPECT_TRUE(row["largest_seen"].is_null()) << row["name"];
    }
    EXPECT_EQ(row["factor"], check::ledger()[i].factor);
  }
}

TEST_F(Reports, LedgerFileHasEachGroupsLargestDifferences) {
  SceneVerdict other = verdict_of({compared(Outcome::within, 1.26, 8), compared(Outcome::equal, 0, 8)});
  other.scene = "another/scene";
  write_ledger(folder / "ledger.json",
               std::vector{verdict_of({compared(Outcome::within, 1, 8), compared(Outcome::within, 2, 8)}),
                           verdict_of({not_compared(Outcome::unsupported, "")}), other});
  const auto groups = nlohmann::json::parse(test::text_of(folder / "ledger.json"))["groups"];
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0]["name"], "another");
  EXPECT_EQ(groups[0]["scenes"], 1);
  EXPECT_EQ(groups[1]["scenes"], 2);
  ASSERT_EQ(groups[0]["largest_difference"].size(), 1u);
  EXPECT_EQ(groups[0]["largest_difference"].items().begin().value(), "1.3");
  EXPECT_EQ(groups[1]["largest_difference"].items().begin().value(), "2");
  EXPECT_EQ(groups[1]["largest_difference"].items().begin().key(), "osmesa, clip, u");
}

TEST(SafeText, FileNamesAreRelativeAndOfOneTextEach) {
  for (const auto& [text, name] :
       {std::pair("light/two sides", "light/two~20sides"), std::pair("/tmp/x", "~2ftmp/x"), std::pair("a//b", "a/~2fb"),
        std::pair("a/", "a~2f"), std::pair("../.x", "~2e./~2ex"), std::pair("~2f", "~7e2f")})
    EXPECT_EQ(file_name(text), name);
}

TEST_F(Reports, WhereItCannotBeWrittenTheErrorNamesTheFile) {
  write_file(folder / "file", "kept");
  for (const fs::path& target : {folder / "no such folder" / "a.txt", folder / "file" / "a.txt"}) {
    try {
      write_json(target, std::vector<SceneVerdict>{}, {});
      FAIL() << target;
    } catch (const OutputError& e) {
      EXPECT_TRUE(contains(e.what(), target.string())) << e.what();
    }
    EXPECT_THROW(write_ledger(target, {}), OutputError);
  }
  EXPECT_EQ(entries(folder), 1u) << "nothing is left behind";
  EXPECT_EQ(test::text_of(folder / "file"), "kept");
}

}  // namespace
}  // namespace plumbline::report

// Known differences: what occurs is expected, what does not, or no more, fails.
#include <stdexcept>

#include "check/verdict/expectations.h"
#include "scene/json/json_tree.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::check {
namespace {

const std::string kRow = R"({"scene": "light/a", "reference": "osmesa", "stage": "depth", "reason": "a driver's bug",
                             "issue": "mesa 123", "expires": "2030-06-30"})";

const std::vector<std::string> kRenderers = {"osmesa", "exact"};

struct Expectations : TestFolder {
  std::vector<Expectation> read_text(const std::string& text) const {
    test::write_text(root_ / "known.json", text);
    return read_expectations(root_ / "known.json", kRenderers);
  }
  std::vector<Expectation> known() const { return read_text("{\"expectations\": [" + kRow + "]}"); }
  void refused(const std::string& text, const std::string& pointer, const std::string& expected) const {
    try {
      read_text(text);
      ADD_FAILURE() << "taken: " << text;
    } catch (const JsonError& e) {
      const std::string what = e.what();
      EXPECT_NE(what.find("known.json: at \"" + pointer + "\""), std::string::npos) << what;
      EXPECT_NE(what.find("expected " + expected), std::string::npos) << what;
    }
  }
};

SceneVerdict verdict(Outcome outcome, Stage stage = Stage::depth) {
  SceneVerdict out{"light/a", "light/a.json", {not_judged("light/a", "osmesa", stage, outcome, "so")}, 0};
  out.comparisons.push_back(not_judged("light/a", {"exact", Kind::from_scene}, Stage::depth, Outcome::equal, ""));
  return out;
}

const std::vector<std::string> kAsked = {"osmesa", "exact"};

Settled settled_one(const std::vector<Expectation>& known, const std::string& day, SceneVerdict& v) {
  const std::vector<Settled> all = settle_expectations(known, kAsked, day_of(day), v);
  if (all.size() != 1) throw std::logic_error("not one");
  return all[0];
}

TEST_F(Expectations, WhatOccursIsExpectedUntilItsLastDay) {
  const auto known = this->known();
  SceneVerdict v = verdict(Outcome::different);
  EXPECT_EQ(settled_one(known, "2030-06-30", v).fate, Settlement::occurred);
  EXPECT_EQ(v.comparisons[0].outcome, Outcome::expected);
  EXPECT_EQ(v.comparisons[0].note, "known to be different until 2030-06-30: a driver's bug (mesa 123); so");
  EXPECT_EQ(v.comparisons[1].outcome, Outcome::equal);
  EXPECT_FALSE(is_failure(Outcome::expected));
  EXPECT_EQ(first_different(v), nullptr);

  v = verdict(Outcome::different);
  const Settled late = settled_one(known, "2030-07-01", v);
  EXPECT_EQ(late.fate, Settlement::expired);
  EXPECT_EQ(late.line, "expired light/a, osmesa, depth: was expected until 2030-06-30 (a driver's bug, mesa 123)");
  EXPECT_EQ(v.comparisons[0].outcome, Outcome::different) << "still a failure";
}

// One for rows of any kind, and one for this kind: the first leaves the second something to expect.
TEST_F(Expectations, TwoOfOneRowBothOccur) {
  std::vector<Expectation> both = known();
  both.push_back(both[0]);
  both[1].kind = Kind::side_by_side;
  SceneVerdict v = verdict(Outcome::different);
  for (const Settled& settled : settle_expectations(both, kAsked, day_of("2030-06-30"), v))
    EXPECT_EQ(settled.fate, Settlement::occurred) << settled.line;
  EXPECT_EQ(v.comparisons[0].outcome, Outcome::expected);
}

TEST_F(Expectations, WhatPassesUnexpectedlyOrIsNowhereFails) {
  const auto known = this->known();
  for (const Outcome outcome : {Outcome::equal, Outcome::failed, Outcome::unsupported}) {
    SceneVerdict v = verdict(outcome);
    const Settled settled = settled_one(known, "2026-01-01", v);
    EXPECT_EQ(settled.fate, Settlement::passed) << name_of(outcome);
    EXPECT_EQ(settled.line, "unexpected light/a, osmesa, depth: " + std::string(name_of(outcome)) +
                                ", expected different (a driver's bug, mesa 123): the expectation can go");
    EXPECT_EQ(v.comparisons[0].outcome, outcome);
  }
  SceneVerdict v = verdict(Outcome::different, Stage::merge);
  EXPECT_EQ(settled_one(known, "2026-01-01", v).fate, Settlement::unmatched);
  EXPECT_EQ(v.comparisons[0].outcome, Outcome::different);
}

TEST_F(Expectations, AreNotAskedOfOtherScenesAndReferences) {
  const auto known = this->known();
  SceneVerdict v = verdict(Outcome::different);
  EXPECT_TRUE(settle_expectations(known, std::vector<std::string>{"exact"}, day_of("2026-01-01"), v).empty());
  v.scene = "light/b";
  EXPECT_TRUE(settle_expectations(known, kAsked, day_of("2026-01-01"), v).empty());
  EXPECT_EQ(v.comparisons[0].outcome, Outcome::different);
}

TEST_F(Expectations, OfOtherFailures) {
  const auto known = read_text(
      R"({"expectations": [{"scene": "light/a", "reference": "osmesa", "stage": "depth", "outcome": "failed",
                            "reason": "r", "issue": "i", "expires": "2030-06-30"}]})");
  SceneVerdict v = verdict(Outcome::failed);
  EXPECT_EQ(settled_one(known, "2026-01-01", v).fate, Settlement::occurred);
  v = verdict(Outcome::different);
  EXPECT_EQ(settled_one(known, "2026-01-01", v).fate, Settlement::passed)
      << "another failure than the one that is known";
}

TEST_F(Expectations, FilesAreRefusedWithTheirPlace) {
  EXPECT_TRUE(read_text("{\"expectations\": []}").empty());
  refused("{\"expectations\": [" + kRow + ", " + kRow + "]}", "/expectations/1", "each comparison once");
  const auto with = [](std::string from, const std::string& to) {
    std::string row = kRow;
    row.replace(row.find(from), from.size(), to);
    return "{\"expectations\": [" + row + "]}";
  };
  refused(with("2030-06-30", "2030-06-31"), "/expectations/0/expires", "a day as YYYY-MM-DD");
  refused(with("2030-06-30", "2030-6-30"), "/expectations/0/expires", "a day as YYYY-MM-DD");
  refused(with("\"depth\"", "\"dept\""), "/expectations/0/stage", "one of matrices, vertex, light");
  refused(with("\"osmesa\"", "\"mesa\""), "/expectations/0/reference", "a reference, one of");
  refused(with("a driver's bug", ""), "/expectations/0/reason", "");
  refused(with("\"issue\": \"mesa 123\",", ""), "/expectations/0/issue", "a value");
  refused(with("\"issue\"", "\"isue\""), "/expectations/0/isue", "");
  refused(with("\"stage\"", "\"outcome\": \"equal\", \"stage\""), "/expectations/0/outcome", "");
  for (const char* text : {"2026-02-30", "2026-01-01 ", "-026-01-01", "0000-00-00", ""}) {
    EXPECT_THROW(day_of(text), std::invalid_argument) << text;
  }
  EXPECT_EQ(to_string(day_of("2028-02-29")), "2028-02-29");
}

}  // namespace
}  // namespace plumbline::check

// The rule of votes, on rows made up.
#include "check/verdict/votes.h"

#include <cmath>
#include <span>

#include <gtest/gtest.h>

namespace plumbline::check {
namespace {

Comparison row(const JudgeId& judge, Stage stage, Outcome outcome) {
  Comparison c{"test", judge, stage, outcome, {}, "", ""};
  c.measurement.items = 10;
  c.measurement.differing = outcome == Outcome::different ? 3 : 0;
  c.measurement.max_ratio = outcome == Outcome::different ? HUGE_VAL : 0;
  return c;
}

// Rows in which osmesa alone differs, in stage coverage; `more` is appended.
std::vector<Comparison> rows(std::vector<Comparison> more = {}) {
  std::vector<Comparison> out = {
      row("osmesa", Stage::coverage, Outcome::different), row("embree", Stage::coverage, Outcome::ambiguous_only),
      row({"exact", Kind::per_stage}, Stage::coverage, Outcome::equal), row("osmesa", Stage::window, Outcome::within),
      row({"exact", Kind::per_stage}, Stage::window, Outcome::equal)};
  out.insert(out.end(), more.begin(), more.end());
  return out;
}

Comparison settled(std::vector<Comparison> all) {
  settle_votes(all);
  return all[0];
}

TEST(Votes, WhoStandsAloneIsADisputeWithTheEvidence) {
  const Comparison c = settled(rows());
  EXPECT_EQ(c.outcome, Outcome::dispute);
  EXPECT_EQ(c.measurement.disputed, 3u);
  EXPECT_EQ(c.measurement.differing, 0u);
  EXPECT_NE(c.measurement.reason.find("embree and exact"), std::string::npos) << c.measurement.reason;
  EXPECT_EQ(settled(rows({row("osmesa", Stage::merge, Outcome::different)})).outcome, Outcome::dispute)
      << "a later stage is another matter";
}

TEST(Votes, EachOfThemIsNeeded) {
  for (const std::size_t gone : {1u, 2u}) {
    std::vector<Comparison> without = rows();
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(gone));
    EXPECT_EQ(settled(without).outcome, Outcome::different) << gone;
    for (const Outcome outcome :
         {Outcome::unsupported, Outcome::missing, Outcome::failed, Outcome::dispute, Outcome::different}) {
      std::vector<Comparison> other = rows();
      other[gone].outcome = outcome;
      EXPECT_EQ(settled(other).outcome, Outcome::different) << gone << ": " << name_of(outcome);
    }
  }
}

TEST(Votes, OneMoreThatDiffersIsOurs) {
  for (const Stage stage : {Stage::coverage, Stage::vertex, Stage::matrices}) {
    for (const Outcome outcome : {Outcome::different, Outcome::failed}) {
      EXPECT_EQ(settled(rows({row("egl", stage, outcome)})).outcome, Outcome::different) << name_of(stage);
    }
  }
  EXPECT_EQ(settled(rows({row("osmesa", Stage::window, Outcome::different)})).outcome, Outcome::different)
      << "its own earlier stage, which two cannot outvote";
}

TEST(Votes, ABudgetOfAmbiguityIsNobodysNumber) {
  std::vector<Comparison> all = rows();
  all[0].measurement.max_ratio = 1;  // no item is beyond its tolerance: too many are open
  EXPECT_EQ(settled(all).outcome, Outcome::different);
}

TEST(Votes, ExactHasOneVoteAndIsNeverOutvoted) {
  std::vector<Comparison> twice = rows();
  twice[1].judge = {"exact", Kind::from_scene};
  EXPECT_EQ(settled(twice).outcome, Outcome::different);
  std::vector<Comparison> alone = rows({row("egl", Stage::coverage, Outcome::equal)});
  for (const Kind kind : {Kind::from_scene, Kind::per_stage}) {
    alone[0].judge = {"exact", kind};
    alone[2].outcome = kind == Kind::from_scene ? Outcome::equal : Outcome::different;
    EXPECT_EQ(settled(alone).outcome, Outcome::different) << name_of(kind);
  }
}

TEST(Votes, WhoSharesArithmeticIsOneVoice) {
  for (const Stage stage : {Stage::texture, Stage::shade, Stage::visibility, Stage::merge}) {
    std::vector<Comparison> all = rows();
    for (Comparison& c : std::span(all).first(3)) c.stage = stage;
    EXPECT_EQ(settled(all).outcome, Outcome::different) << name_of(stage) << ": embree and exact share it";
    all[1].judge = "softpipe";
    EXPECT_EQ(settled(all).outcome, Outcome::dispute) << name_of(stage);
  }
}

TEST(Votes, OfPlainDrawsShadeIsThePlaneOfAttributes) {
  std::vector<Comparison> all = rows();
  for (Comparison& c : std::span(all).first(3)) c.stage = Stage::shade;
  settle_votes(all, true);
  EXPECT_EQ(all[0].outcome, Outcome::dispute);
  for (Comparison& c : std::span(all).first(3)) c.stage = Stage::visibility;
  all[0].outcome = Outcome::different;
  settle_votes(all, true);
  EXPECT_EQ(all[0].outcome, Outcome::different);
}

TEST(Votes, WhatIsSettledStandsInNoLaterStagesWay) {
  std::vector<Comparison> all = {row("embree", Stage::visibility, Outcome::different),
                                 row("osmesa", Stage::visibility, Outcome::equal),
                                 row({"exact", Kind::per_stage}, Stage::visibility, Outcome::equal)};
  const std::vector<Comparison> of_coverage = rows();
  all.insert(all.end(), of_coverage.begin(), of_coverage.end());
  EXPECT_EQ(settled(all).outcome, Outcome::dispute);
}

// Embree alone misses a triangle at one pixel; nobody else can judge the frame's format.
TEST(Votes, AFrameFollowsFromWinnersThatAreOutvoted) {
  const auto all = [](std::vector<glm::ivec2> winners_at, std::vector<glm::ivec2> colors_at) {
    std::vector<Comparison> out = {row("embree", Stage::merge, Outcome::different),
                                   row("embree", Stage::visibility, Outcome::different),
                                   row("osmesa", Stage::visibility, Outcome::equal),
                                   row({"exact", Kind::per_stage}, Stage::visibility, Outcome::equal),
                                   row({"exact", Kind::per_stage}, Stage::merge, Outcome::equal)};
    out[0].measurement.differing = colors_at.size(), out[0].measurement.differing_at = std::move(colors_at);
    out[1].measurement.differing_at = std::move(winners_at);
    return out;
  };
  EXPECT_EQ(settled(all({{0, 4}, {1, 4}}, {{1, 4}})).outcome, Outcome::dispute);
  EXPECT_EQ(settled(all({{0, 4}}, {{0, 4}, {1, 4}})).outcome, Outcome::different) << "a pixel more";
  EXPECT_EQ(settled(all({}, {{1, 4}})).outcome, Outcome::different);
  std::vector<Comparison> unlisted = all({{0, 4}}, {{0, 4}});
  unlisted[0].measurement.differing = 2;
  EXPECT_EQ(settled(unlisted).outcome, Outcome::different) << "not all pixels are listed";
  for (const std::size_t needed : {3u, 4u}) {
    std::vector<Comparison> without = all({{0, 4}}, {{0, 4}});
    without[needed].outcome = Outcome::unsupported;
    EXPECT_EQ(settled(without).outcome, Outcome::different) << needed;
  }
  std::vector<Comparison> also = all({{0, 4}}, {{0, 4}});
  also.push_back(row({"exact", Kind::from_scene}, Stage::merge, Outcome::different));
  EXPECT_EQ(settled(also).outcome, Outcome::different) << "another differs as well";
}

// Outcome of the first row after leave_recipes_to_exact().
Outcome first_left(std::vector<Comparison> all) {
  leave_recipes_to_exact(all);
  return all[0].outcome;
}

TEST(Recipes, OneThatIsNotFollowedIsLeftToExact) {
  const Comparison beside = row("osmesa", Stage::vertex, Outcome::different);
  const Comparison alone = row({"exact", Kind::per_stage}, Stage::vertex, Outcome::within);
  const Comparison from_scene = row({"exact", Kind::from_scene}, Stage::vertex, Outcome::within);
  EXPECT_EQ(first_left({beside, alone}), Outcome::unsupported);
  EXPECT_EQ(first_left({beside, from_scene}), Outcome::unsupported);
  EXPECT_EQ(first_left({beside, alone, from_scene}), Outcome::unsupported);
}

TEST(Recipes, WhatExactCannotJudgeOfTheGeometryIsNobodys) {
  for (const Stage stage : {Stage::vertex, Stage::window}) {
    const Comparison beside = row("osmesa", stage, Outcome::different),
                     lacking = row({"exact", Kind::per_stage}, stage, Outcome::unsupported);
    EXPECT_EQ(first_left({beside, lacking}), Outcome::unsupported);
    EXPECT_EQ(first_left({beside, lacking, row({"exact", Kind::from_scene}, stage, Outcome::different)}),
              Outcome::different);
  }
  const Comparison depth = row("osmesa", Stage::depth, Outcome::different),
                   lacking = row({"exact", Kind::per_stage}, Stage::depth, Outcome::unsupported);
  EXPECT_EQ(first_left({depth, lacking}), Outcome::different) << "its tolerance is of both arithmetics";
}

TEST(Recipes, NothingElseIsLeftToExact) {
  const Comparison beside = row("osmesa", Stage::vertex, Outcome::different);
  const Comparison wrong = row({"exact", Kind::from_scene}, Stage::vertex, Outcome::different);
  EXPECT_EQ(first_left({beside}), Outcome::different) << "nobody else judges it";
  EXPECT_EQ(first_left({beside, row({"exact", Kind::per_stage}, Stage::light, Outcome::within)}), Outcome::different);
  EXPECT_EQ(first_left({beside, row("embree", Stage::vertex, Outcome::within)}), Outcome::different);
  EXPECT_EQ(first_left({beside, wrong}), Outcome::different);
  EXPECT_EQ(first_left({beside, row({"exact", Kind::per_stage}, Stage::vertex, Outcome::within), wrong}),
            Outcome::different);
  EXPECT_EQ(first_left({row("osmesa", Stage::vertex, Outcome::dispute), wrong}), Outcome::dispute);
  EXPECT_EQ(first_left({row({"exact", Kind::per_stage}, Stage::vertex, Outcome::different)}), Outcome::different);
}

}  // namespace
}  // namespace plumbline::check

// The list of faults, and the arithmetic of the fault matrix. Test `fault_matrix` and scripts/fault_matrix show that
// each fault is seen and its stage named.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "faults/faults.h"
#include "kernels/coverage.h"
#include "matrix/legal.h"
#include "matrix/matrix.h"
#include "matrix/report.h"
#include "pipeline/stages.h"
#include "tests/check/judge/frame_verdict.h"
#include "tests/suite.h"
#include "tests/text_file.h"

namespace plumbline {

namespace {

TEST(Faults, ThereAreFiveInEachStageAndTwentyThatOthersReport) {
  std::map<Stage, int> count;
  std::set<std::string_view> names;
  int reported = 0;
  for (const faults::Fault& fault : faults::of_stages()) {
    ++count[fault.stage];
    names.insert(fault.name);
    reported += fault.report.empty() ? 0 : 1;
    EXPECT_TRUE(std::string(fault.name).starts_with(name_of(fault.stage))) << fault.name;
  }
  EXPECT_GE(names.size(), 80u);
  EXPECT_EQ(names.size(), faults::of_stages().size()) << "two of one name";
  EXPECT_GE(reported, 20);
  for (std::size_t i = 0; i < kStageNames.size(); ++i) EXPECT_GE(count[static_cast<Stage>(i)], 5) << kStageNames[i];
}

TEST(Faults, AreAsManyAsTheReadmeSays) {
  const std::string text = test::text_of(PLUMBLINE_SOURCE_DIR "/tests/README.md");
  const auto reported = std::ranges::count_if(faults::of_stages(), [](const auto& f) { return !f.report.empty(); });
  const std::size_t all = faults::all().size(), of_stages = faults::of_stages().size();
  for (const std::string& part : {fmt::format("{} bugs ({} of them from public bug reports", of_stages, reported),
                                  fmt::format("the notes' {} mistakes", all - of_stages),
                                  fmt::format("{} legal variants", faults::legal_variants().size())}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

matrix::Subject subject_of(std::string_view name) {
  const faults::Fault fault = faults::named(name);
  return {std::string(name), fault.stages(), {fault.stage}};
}

// Attributes without perspective, and levels of detail with it.
TEST(Faults, ThatAreAConventionHoldWhereItIsDeclared) {
  Conventions affine;
  affine.interpolation = Conventions::Interpolation::affine;
  const auto verdict = [](const Conventions& declared) {
    return test::verdict_of(test::narrow_floor(), pipeline::make_pipeline(faults::named("attributes.affine").stages()),
                            declared);
  };
  EXPECT_TRUE(test::is_right(verdict(affine)));
  EXPECT_TRUE(test::is_wrong(verdict(Conventions())));
}

// Geometry, pixels, records alone and what is resolved; and nothing where it is not asked for.
TEST(FaultMatrix, AFaultAffectsTheScenesThatItChanges) {
  const std::vector<Scene> scenes = {suite_scene("coverage/shared_edges"), suite_scene("antialias/supersample_3"),
                                     suite_scene("light/flat_sphere")};
  const std::vector<matrix::Subject> subjects = {
      {"ours", pipeline::production_stages(), {}}, subject_of("window.y_flipped"),
      subject_of("coverage.inclusive_edges"),      subject_of("texture.t_flipped"),
      subject_of("resolve.first_sample"),          subject_of("vertex.not_renormalised")};
  const std::vector<matrix::SceneList> on = matrix::affected(scenes, subjects, 3, 2);
  using L = matrix::SceneList;
  EXPECT_EQ(on[0], L());
  EXPECT_EQ(on[1], (L{0, 1, 2}));
  EXPECT_TRUE(std::ranges::count(on[2], 0u) == 1);
  EXPECT_EQ(on[3], L());
  EXPECT_EQ(on[4], (L{1}));
  EXPECT_TRUE(std::ranges::count(on[5], 2u) == 1);
  EXPECT_EQ(matrix::affected(scenes, subjects, 1, 1)[1], (L{0}));
}

TEST(FaultMatrix, RightIsTheStageAndNoOther) {
  using S = std::vector<Stage>;
  const matrix::Subject fault{"", {}, {Stage::depth}}, pair{"", {}, {Stage::light, Stage::depth}}, legal{"", {}, {}};
  const auto answer = [](std::optional<Stage> first, S wrong, std::string failed = "") {
    return matrix::Answer{0, first ? "a row" : "", first, std::move(wrong), std::move(failed)};
  };
  EXPECT_TRUE(is_right(answer(Stage::depth, {Stage::depth}), fault));
  EXPECT_FALSE(is_right(answer(Stage::light, {Stage::depth}), fault));
  EXPECT_FALSE(is_right(answer(Stage::depth, {Stage::depth, Stage::merge}), fault));
  EXPECT_FALSE(is_right(answer(Stage::depth, {}), fault));
  EXPECT_FALSE(is_right(answer(std::nullopt, {}), fault));
  EXPECT_FALSE(is_right(answer(Stage::depth, {Stage::depth}, "crashed"), fault));
  EXPECT_TRUE(is_right(answer(Stage::light, {Stage::light, Stage::depth}), pair));
  EXPECT_FALSE(is_right(answer(Stage::light, {Stage::light}), pair));
  EXPECT_TRUE(is_right(answer(std::nullopt, {}), legal));
  EXPECT_FALSE(is_right(answer(Stage::depth, {}), legal));
  EXPECT_FALSE(is_right(answer(std::nullopt, {Stage::depth}), legal));
}

TEST(FaultMatrix, WhatMustHold) {
  const matrix::Answer right{0, "a row", Stage::depth, {Stage::depth}, ""}, not_seen{0, "", {}, {}, ""};
  const matrix::Subject depth{"", {}, {Stage::depth}};
  matrix::Matrix m;
  m.faults = {{depth, 100, std::vector<matrix::Answer>(97, right)}};
  EXPECT_TRUE(holds(shares(m)));
  m.faults[0].answers.resize(100, not_seen);
  EXPECT_TRUE(holds(shares(m))) << "97 of 100";
  m.faults[0].answers[0] = not_seen;
  EXPECT_FALSE(holds(shares(m))) << "96 of 100";
  m.faults[0].answers.assign(100, right);
  m.faults.push_back({depth, 1, {not_seen}});
  EXPECT_FALSE(holds(shares(m))) << "a fault that is nowhere seen";
  m.faults.pop_back();
  m.legal = {{{"", {}, {}}, 1, {right}}};
  EXPECT_FALSE(holds(shares(m))) << "an alarm";
}

TEST(FaultMatrix, TheSampleIsSpread) {
  const matrix::SceneList six = {0, 2, 4, 6, 8, 10};
  EXPECT_EQ(matrix::spread(six, 3), (matrix::SceneList{0, 4, 8}));
  EXPECT_EQ(matrix::spread(six, 9), six);
}

using Pixels = std::vector<std::pair<int, int>>;  // y, x

Pixels covered_with(const pipeline::Stages& stages, const pipeline::WindowTriangle& t) {
  Pixels out;
  for (const glm::ivec2 p : stages.coverage(t, {0, 0, 64, 64})) out.emplace_back(p.y, p.x);
  std::ranges::sort(out);
  return out;
}

// Corners on rows' centres: edges begin there, stepped or not. Each row loses one pixel of its span, and one row is
// lost.
TEST(Faults, OfScanlinesLeaveTrianglesOnRowCentresRight) {
  std::mt19937 random(4);
  const auto in = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
  const auto stages_of = [](std::string_view name) { return faults::named(name).stages(); };
  std::size_t rows_lost = 0;
  for (int i = 0; i < 300; ++i) {
    pipeline::WindowTriangle t{};
    t.corners = 3;
    for (auto& v : t.v) v.snapped = {in(64 * 256), 256 * in(64)};
    t.front = snapped_area(t) > 0;
    if (snapped_area(t) == 0) continue;
    const Pixels right = covered_with(pipeline::production_stages(), t);
    std::map<int, std::size_t> of_row;
    for (const auto& [y, x] : right) ++of_row[y];
    EXPECT_EQ(covered_with(stages_of("coverage.edges_not_advanced"), t), right);
    for (const char* name : {"coverage.first_of_spans_lost", "coverage.last_of_spans_lost"})
      EXPECT_EQ(covered_with(stages_of(name), t).size(), right.size() - of_row.size()) << name;
    for (const char* name : {"coverage.row_below_middle_lost", "coverage.row_above_middle_lost"}) {
      const std::size_t left = covered_with(stages_of(name), t).size();
      const auto is_row = [&](const auto& row) { return left + row.second == right.size(); };
      EXPECT_TRUE(left == right.size() || std::ranges::any_of(of_row, is_row)) << name;
      rows_lost += left < right.size();
    }
  }
  EXPECT_GT(rows_lost, 300u);
}

}  // namespace
}  // namespace plumbline

// The comparators of resolved colours, and the rows of an antialiased scene.
#include "check/judge/judge_passes.h"
#include "scene/antialias.h"
#include "tests/check/judge/judge_fixtures.h"

namespace plumbline::check {
namespace {

constexpr float code(double c) { return static_cast<float>(c / 255); }

// One pixel of four samples.
struct Resolved : testing::Test {
  Resolved() {
    scene.frame.width = scene.frame.height = 1;
    scene.frame.antialias.kind = Antialias::Kind::multisample;
  }
  static Capture of(const std::vector<double>& samples, double resolved) {
    Capture c;
    for (double s : samples) c.samples.emplace_back(1, 1, glm::vec4(code(s)));
    c.planes.color = Plane<glm::vec4>(1, 1, glm::vec4(code(resolved)));
    return c;
  }
  bool by_exact(const std::vector<double>& samples, double resolved, double mean) const {
    return compare_resolved(scene, of(samples, resolved), of(samples, mean), 1).differing == 0;
  }
  bool side_by_side(const Capture& a, const Capture& b) const { return compare_frames(scene, a, b).differing == 0; }
  Scene scene;
};

TEST_F(Resolved, IsWithinHalfACodeOfTheMeanThatExactMakes) {
  EXPECT_TRUE(by_exact({1, 2, 3, 4}, 2, 2.5));
  EXPECT_TRUE(by_exact({1, 2, 3, 4}, 3, 2.5)) << "halves may go either way";
  EXPECT_TRUE(by_exact({1, 2, 3, 5}, 3, 2.75));
  EXPECT_FALSE(by_exact({1, 2, 3, 5}, 2, 2.75)) << "truncated";
  EXPECT_FALSE(by_exact({1, 2, 3, 5}, 2.75, 2.75)) << "no code";
  EXPECT_FALSE(by_exact({1, 2, 3, 5}, std::nan(""), 2.75));
  scene.frame.color = ColorFormat::rgba32f;
  EXPECT_TRUE(by_exact({1, 2, 3, 5}, 2.75, 2.75));
  EXPECT_TRUE(by_exact({1, 2, 3, 5}, 2.75 * (1 + 4 * kU), 2.75));
  EXPECT_FALSE(by_exact({1, 2, 3, 5}, 2.75 * (1 + 40 * kU), 2.75));
}

TEST_F(Resolved, IsTheReferencesWhereTheSamplesAre) {
  EXPECT_TRUE(side_by_side(of({1, 2, 3, 4}, 2), of({1, 2, 3, 4}, 2)));
  EXPECT_FALSE(side_by_side(of({1, 2, 3, 4}, 2), of({1, 2, 3, 4}, 3))) << "not a code";
  // The samples' difference, 8 / 4, and a rounding.
  EXPECT_TRUE(side_by_side(of({1, 2, 3, 4}, 2), of({1, 2, 3, 12}, 5)));
  EXPECT_FALSE(side_by_side(of({1, 2, 3, 4}, 2), of({1, 2, 3, 12}, 6)));
  EXPECT_FALSE(side_by_side(of({1, 2, 3, 4}, 2), of({1, 2, 3, 4}, std::nan(""))));
  Capture other_size = of({1, 2, 3, 4}, 2);
  other_size.planes.color = Plane<glm::vec4>(2, 1);
  EXPECT_FALSE(side_by_side(of({1, 2, 3, 4}, 2), other_size));
  scene.frame.color = ColorFormat::rgba32f;
  EXPECT_TRUE(side_by_side(of({1, 2, 3, 4}, 2), of({1, 2, 3, 4}, 2)));
  EXPECT_FALSE(side_by_side(of({1, 2, 3, 4}, 2), of({1, 2, 3, 4}, 2.00001)));
  // Below the smallest normal number, 2^-126, a mean may be flushed to zero, whatever the samples.
  const double tiny = 255 * 0x1p-128, normal = 255 * 0x1p-125;
  const Capture flushed = of({0, 0, 0, 0}, 0);
  EXPECT_TRUE(side_by_side(of({tiny, tiny, tiny, tiny}, tiny), flushed));
  EXPECT_TRUE(side_by_side(of({tiny, tiny, tiny, tiny}, tiny), of({tiny, tiny, tiny, tiny}, 0)));
  EXPECT_TRUE(side_by_side(of({tiny, tiny, tiny, tiny}, tiny), of({tiny, tiny, tiny, 2 * tiny}, 0)));
  EXPECT_FALSE(side_by_side(of({normal, normal, normal, normal}, normal), of({normal, normal, normal, normal}, 0)));
  EXPECT_FALSE(side_by_side(of({tiny, tiny, tiny, tiny}, 32 * normal), flushed));
}

TEST_F(Resolved, SamplesAreThoseOfThePassesBitForBit) {
  const auto holds = [&](const std::vector<double>& samples, const std::vector<double>& passes) {
    return compare_samples(scene, of(samples, 0), of(passes, 0).samples).differing == 0;
  };
  EXPECT_TRUE(holds({1, 2, 3, 4}, {1, 2, 3, 4}));
  EXPECT_FALSE(holds({1, 2, 3, 4}, {1, 2, 3, 4 + 1e-4}));
  EXPECT_FALSE(holds({1, 2, 3, 4}, {2, 1, 3, 4})) << "in another order";
  EXPECT_FALSE(holds({1, 2, 3, 4}, {1, 2, 3}));
  EXPECT_FALSE(holds({1, 2, 3}, {1, 2, 3, 4}));
  EXPECT_FALSE(holds({0, 2, 3, 4}, {-0.0, 2, 3, 4}));
  EXPECT_FALSE(holds({std::nan(""), 2, 3, 4}, {1, 2, 3, 4}));
  Capture passes = of({1, 2, 3, 4}, 0);
  passes.samples[0] = Plane<glm::vec4>(1, 2);
  EXPECT_GT(compare_samples(scene, of({1, 2, 3, 4}, 0), passes.samples).differing, 0u) << "of another size";
  passes.samples[0] = {};  // not drawn: the passes' rows say so
  EXPECT_EQ(compare_samples(scene, of({1, 2, 3, 4}, 0), passes.samples).differing, 0u);
}

TEST_F(Resolved, WhatDisputedSamplesAloneExplainIsDisputed) {
  const Capture mine = of({1, 2, 3, 4}, 2);
  Disputed disputed{{{}, {}, {}, {{0, 0}}}, "switched early"};
  const auto against = [&](const std::vector<double>& samples, double resolved) {
    const Measurement m = compare_frames(scene, mine, of(samples, resolved), disputed);
    return std::array{m.differing, m.disputed};
  };
  using Counts = std::array<std::uint64_t, 2>;
  EXPECT_EQ(against({1, 2, 3, 12}, 5), (Counts{0, 1})) << "8 / 4, of the disputed sample, and a rounding";
  EXPECT_EQ(against({1, 2, 3, 12}, 6), (Counts{1, 0})) << "more than it explains";
  EXPECT_EQ(against({1, 2, 11, 4}, 5), (Counts{0, 0})) << "of another sample";
  EXPECT_EQ(against({1, 2, 3, 4}, 3), (Counts{1, 0})) << "its samples are ours";
  const Measurement m = compare_frames(scene, mine, of({1, 2, 3, 12}, 5), disputed);
  EXPECT_EQ(m.reason, "switched early");
  EXPECT_EQ(to_string(m.dispute.place), "pixel 0,0 color");
  EXPECT_NEAR(m.dispute.difference, 3, 1e-5);
  disputed.at = {{{0, 0}}, {}, {}, {}};
  EXPECT_EQ(against({1, 2, 3, 12}, 5), (Counts{0, 0})) << "of another pass";
}

struct JudgePasses : Judge {
  JudgePasses() { scene.frame.antialias = {Antialias::Kind::taps, 1}; }
};

TEST_F(JudgePasses, EachStageHasOneRowOfAllPassesAndTheWholeItsOwn) {
  const Results rows = run({{"witness", &witness}, {"exact", &referee}});
  const auto pixels = static_cast<std::uint64_t>(scene.frame.width * scene.frame.height);
  EXPECT_EQ(rows.at({"witness", Stage::coverage}).measurement.items, 6 * pixels);
  EXPECT_EQ(rows.at({"witness", Stage::coverage}).outcome, Outcome::equal);
  EXPECT_EQ(rows.at({"witness", Stage::resolve}).measurement.items, pixels);
  EXPECT_EQ(rows.at({"witness", Stage::resolve}).outcome, Outcome::equal);
  EXPECT_EQ(rows.at({"exact, per stage", Stage::resolve}).ledger_row, "exact.resolve");
  EXPECT_EQ(first_different(verdict), nullptr);
}

TEST_F(JudgePasses, OnePassThatDiffersIsNamed) {
  int captures = 0;
  witness.on_capture = [&](Capture& c) {
    if (++captures == 3) c.planes.count(1, 1) += 1;
  };
  const Results rows = run({{"witness", &witness}});
  const Comparison& coverage = rows.at({"witness", Stage::coverage});
  EXPECT_EQ(coverage.outcome, Outcome::different);
  EXPECT_EQ(coverage.measurement.differing, 1u);
  EXPECT_EQ(coverage.note, "pass 2");
}

TEST_F(JudgePasses, AWitnessWithoutSamplesHasNotFailedButAWrongOneHas) {
  witness.on_info = [](RendererInfo& info) {
    info.name = "witness";
    info.profile = Profile::opengl;
    for (Ability& a : info.stages) a.runs = false;
    info.legal = false;
    info[Stage::resolve] = {false, false, "no samples"};
  };
  EXPECT_EQ(run({{"witness", &witness}}).at({"witness", Stage::resolve}).outcome, Outcome::unsupported);
  witness.on_info = [](RendererInfo& info) {
    info.name = "witness";
    info.profile = Profile::opengl;
    for (Ability& a : info.stages) a.runs = false;
    info.legal = false;
  };
  witness.on_capture = [](Capture& c) { c.samples.clear(); };
  EXPECT_EQ(run({{"witness", &witness}}).at({"witness", Stage::resolve}).outcome, Outcome::failed);
}

}  // namespace
}  // namespace plumbline::check

// judge(), where renderers contradict each other: ambiguity, its budget, and disputes.
#include "tests/check/judge/judge_fixtures.h"

namespace plumbline::check {
namespace {

TEST_F(Judge, AnOracleWhoseAnswersExcludeOursIsDifferent) {
  glm::ivec2 where(0);
  oracle.on_capture = [&](Capture& c) {
    where = covered_pixel(c.planes);
    const auto i = static_cast<std::size_t>(where.y * 24 + where.x);
    ASSERT_EQ(c.legal.first[i + 1] - c.legal.first[i], 1u);
    c.legal.answers[c.legal.first[i]] = {kBackground, 0, 1, 1, glm::vec4(1, 0, 1, 1)};
    c.legal.certain(where.x, where.y) = c.legal.possible(where.x, where.y) = 0;
  };
  const Results results = run({{"oracle", &oracle}, {"exact", &referee}});
  for (Stage stage : {Stage::depth, Stage::attributes, Stage::merge}) {
    EXPECT_NE(results.at({"oracle", stage}).outcome, Outcome::different) << "of a winner that is not legal";
  }
  for (Stage stage : {Stage::coverage, Stage::visibility}) {
    const Comparison& c = results.at({"oracle", stage});
    EXPECT_EQ(c.outcome, Outcome::different) << name_of(stage);
    EXPECT_EQ(c.measurement.differing, 1u) << name_of(stage);
    EXPECT_EQ(glm::ivec2(c.measurement.worst.place.x, c.measurement.worst.place.y), where) << name_of(stage);
  }
  EXPECT_EQ(first_different(verdict)->stage, Stage::coverage);
  EXPECT_EQ(first_different(verdict)->judge.reference, "oracle");
}

TEST_F(Judge, OfManyFragmentsAWinnerApartIsSettledByTheAnswersAtThatPixel) {
  const glm::ivec2 where = covered_pixel(referee.capture(scene, Request{}).planes);
  referee.on_info = [](RendererInfo& info) { info.legal = true; };
  witness.on_capture = [&](Capture& c) { c.planes.id(where.x, where.y) += 1; };
  bool either = false;
  std::vector<glm::ivec2> asked;
  referee.before_capture = [&](const Request& r) {
    if (r.legal) asked = r.pixels;
  };
  referee.on_capture = [&](Capture& c) {
    if (!either || c.legal.empty()) return;
    Legal& legal = c.legal;
    const auto i = static_cast<std::size_t>(where.y * 24 + where.x);
    LegalAnswer other = legal.at(where.x, where.y)[0];
    other.primitive += 1;
    legal.answers.insert(legal.answers.begin() + legal.first[i], other);
    for (std::size_t k = i + 1; k < legal.first.size(); ++k) ++legal.first[k];
  };
  const auto visibility = [&] {
    const Reference references[] = {{"witness", &witness}, {"exact", &referee}};
    for (const Comparison& c : judge(scene, candidate, references, nullptr, 0).comparisons) {
      if (c.judge.reference == "witness" && c.stage == Stage::visibility) return c.outcome;
    }
    return Outcome::missing;
  };
  EXPECT_EQ(visibility(), Outcome::dispute) << "its winner is not legal, ours is";
  EXPECT_EQ(asked, std::vector{where});
  either = true;
  EXPECT_EQ(visibility(), Outcome::ambiguous_only);
}

TEST_F(Judge, MoreAmbiguityThanPredictedIsDifferent) {
  double predicted = 0;
  oracle.on_capture = [&](Capture& c) {
    c.legal.predicted_ambiguous = predicted;
    Legal open = c.legal;  // every pixel has two answers
    open.answers.clear();
    open.first = {0};
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 24; ++x) {
        open.answers.push_back(c.legal.at(x, y)[0]);
        open.answers.push_back(c.legal.at(x, y)[0]);
        open.first.push_back(static_cast<std::uint32_t>(open.answers.size()));
      }
    }
    c.legal = open;
  };
  const auto visibility = [&](double p) {
    predicted = p;
    return run({{"oracle", &oracle}}).at({"oracle", Stage::visibility});
  };
  // Of 384 pixels twice the prediction and three standard deviations: 2 p + 3 sqrt(2 p + 1).
  EXPECT_EQ(visibility(384).outcome, Outcome::ambiguous_only);
  EXPECT_EQ(visibility(165).outcome, Outcome::ambiguous_only) << "384.6";
  EXPECT_EQ(visibility(164).outcome, Outcome::different) << "382.4";
  EXPECT_EQ(visibility(kNaN).outcome, Outcome::different) << "no prediction is no budget";
  const Comparison none = visibility(0);
  EXPECT_EQ(none.outcome, Outcome::different);
  EXPECT_EQ(none.measurement.ambiguous, 384u);
  EXPECT_LE(none.measurement.differing, none.measurement.items);
  EXPECT_NE(none.note.find("384 ambiguous, 0.0 predicted"), std::string::npos) << none.note;
}

TEST_F(Judge, ARefereeBeyondItsBudgetIsNoFailure) {
  referee.before_run = [](Stage stage) {
    if (stage == Stage::coverage) throw OverBudget("too many fragments");
    if (stage == Stage::depth) throw std::runtime_error("too many fragments");
  };
  const Results results = run();
  const Comparison& c = results.at({"exact, per stage", Stage::coverage});
  EXPECT_EQ(c.outcome, Outcome::unsupported);
  EXPECT_EQ(c.note, "too many fragments");
  EXPECT_EQ(results.at({"exact, per stage", Stage::depth}).outcome, Outcome::failed);
}

TEST_F(Judge, ARefereeThatThrowsOverADisputeDoesNotFailTheWitness) {
  referee.before_run = [](Stage stage) {
    if (stage == Stage::coverage) throw std::runtime_error("out of range");
  };
  witness.on_capture = [](Capture& c) { c.planes.count(5, 5) += 1; };
  const Results results = run();
  EXPECT_EQ(results.at({"witness", Stage::coverage}).outcome, Outcome::different) << "nobody settled it";
  EXPECT_TRUE(results.contains({"witness", Stage::depth})) << "its other stages are still judged";
  for (const auto& [key, c] : results) {
    EXPECT_FALSE(key.first == "witness" && c.outcome == Outcome::failed) << "the referee failed, not the witness";
  }
}

TEST_F(Judge, AWitnessThatContradictsItsOwnTrianglesIsADispute) {
  witness.on_capture = [](Capture& c) {
    c.planes.count(5, 5) += 1;
    c.planes.id_sum(5, 5) += id_weight(0);
  };
  const Results results = run();
  const Comparison& c = results.at({"witness", Stage::coverage});
  EXPECT_EQ(c.outcome, Outcome::dispute);
  EXPECT_EQ(c.measurement.disputed, 1u);
  EXPECT_EQ(c.measurement.differing, 0u);
  EXPECT_NE(c.measurement.reason, "");
  EXPECT_EQ(to_string(c.measurement.dispute.place), "pixel 5,5 count");
  EXPECT_EQ(first_different(verdict), nullptr);
  // Nobody to settle it.
  EXPECT_EQ(run({{"witness", &witness}}).at({"witness", Stage::coverage}).outcome, Outcome::different);
  // Nor without its triangles, if nobody else holds against it.
  witness.on_capture = [](Capture& capture) { capture.planes.count(5, 5) += 1, capture.records.triangles.clear(); };
  EXPECT_EQ(run({{"witness", &witness}, {"exact", &referee}}).at({"witness", Stage::coverage}).outcome,
            Outcome::different);
}

TEST_F(Judge, AReferenceThatTheOthersOutvoteIsADispute) {
  oracle.on_capture = [&](Capture& c) {  // of one pixel it knows another answer
    const glm::ivec2 where = covered_pixel(c.planes);
    c.legal.answers[c.legal.first[static_cast<std::size_t>(where.y * 24 + where.x)]].primitive = kBackground;
    c.legal.certain(where.x, where.y) = c.legal.possible(where.x, where.y) = 0;
  };
  Results results = run();
  for (Stage stage : {Stage::coverage, Stage::visibility}) {
    const Comparison& c = results.at({"oracle", stage});
    EXPECT_EQ(c.outcome, Outcome::dispute) << name_of(stage);
    EXPECT_EQ(c.measurement.disputed, 1u);
    EXPECT_EQ(c.measurement.differing, 0u);
    EXPECT_NE(c.measurement.reason.find("exact and witness"), std::string::npos) << c.measurement.reason;
  }
  EXPECT_EQ(first_different(verdict), nullptr);
  // Two against two, or exact's own arithmetic against us: ours.
  candidate.on_capture = witness.on_capture = [](Capture& c) { c.planes.id.values().assign(24 * 16, kBackground); };
  EXPECT_EQ(run().at({"oracle", Stage::visibility}).outcome, Outcome::different);
  // A window position that is wrong, and what follows from it: exact finds it in order, and the witness shares it.
  candidate.on_capture = witness.on_capture = [](Capture& c) { c.records.matrices[0].win_translate.x += 1; };
  EXPECT_EQ(run().at({"oracle", Stage::coverage}).outcome, Outcome::different) << "an earlier stage differs";
}

TEST_F(Judge, ACandidateThatIsWrongIsDifferentNotADispute) {
  candidate.on_capture = [](Capture& c) { c.planes.count(5, 5) += 1; };
  const Results results = run();
  for (const char* reference : {"witness", "oracle", "exact, per stage"}) {
    EXPECT_EQ(results.at({reference, Stage::coverage}).outcome, Outcome::different) << reference;
  }
  EXPECT_EQ(first_different(verdict)->stage, Stage::coverage);
  // Both wrong, at different pixels: still our failure.
  witness.on_capture = [](Capture& c) { c.planes.count(6, 6) += 1; };
  EXPECT_EQ(run().at({"witness", Stage::coverage}).outcome, Outcome::different);
}

TEST_F(Judge, TheOracleDecidesBetweenTheWinnersOfOthers) {
  glm::ivec2 where(0);
  bool ours_too = true;
  oracle.on_capture = [&](Capture& c) {  // primitive 0 may be at a pixel, and ours may be or not
    where = covered_pixel(c.planes);
    const auto i = static_cast<std::size_t>(where.y * 24 + where.x);
    LegalAnswer other = c.legal.at(where.x, where.y)[0];
    other.primitive = other.primitive == 0 ? 1 : 0;
    const auto at = c.legal.answers.begin() + c.legal.first[i];
    if (!ours_too) {
      *at = other;
      return;
    }
    c.legal.answers.insert(at, other);
    for (std::size_t k = i + 1; k < c.legal.first.size(); ++k) ++c.legal.first[k];
  };
  const auto other_winner = [&](Capture& c) {
    where = covered_pixel(c.planes);
    c.planes.id(where.x, where.y) = c.planes.id(where.x, where.y) == 0 ? 1 : 0;
  };
  witness.on_capture = other_winner;
  EXPECT_EQ(run().at({"witness", Stage::visibility}).outcome, Outcome::ambiguous_only) << "both are legal";
  EXPECT_EQ(run({{"witness", &witness}}).at({"witness", Stage::visibility}).outcome, Outcome::different) << "who knows";
  ours_too = false;
  EXPECT_EQ(run().at({"witness", Stage::visibility}).outcome, Outcome::different) << "the witness' alone is legal";
  oracle.on_capture = [](auto&) {};
  EXPECT_EQ(run().at({"witness", Stage::visibility}).outcome, Outcome::dispute) << "ours alone is legal";
  EXPECT_EQ(first_different(verdict), nullptr);
}

}  // namespace
}  // namespace plumbline::check

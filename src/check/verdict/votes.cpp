#include "check/verdict/votes.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumbline::check {

namespace {

bool fails(const Comparison& row) { return row.outcome == Outcome::different || row.outcome == Outcome::failed; }

// Independent voter behind a row. From stage `shared` on Embree and exact share the arithmetic of texels, light, fog,
// formats and blending (reference/arithmetic): one vote.
std::string voice(const Comparison& row, Stage shared) {
  const std::string& name = row.judge.reference;
  return row.stage >= shared && name == "embree" ? "exact" : name;
}

// The voices that hold against `row`; none where it is not outvoted.
std::set<std::string> outvoted_by(const Comparison& row, const std::vector<Comparison>& rows, Stage shared) {
  std::set<std::string> against;
  std::string exact;
  for (const Comparison& other : rows) {
    const bool own = other.judge.reference == row.judge.reference;
    if (!votes(other) || other.stage > row.stage || (own && other.stage == row.stage)) continue;
    if (fails(other)) return {};
    if (other.stage < row.stage || !holds(other.outcome)) continue;
    if (other.judge.kind == Kind::per_stage) exact = voice(other, shared);
    against.insert(voice(other, shared));
  }
  return exact.empty() || against.size() < 2 ? std::set<std::string>() : against;
}

// Whether the row is of merge, differs only at pixels where its reference has other winners and is outvoted on these
// winners, and exact, on the candidate's own records, and every other row of the stage hold.
bool follows_from_winners(const Comparison& row, const std::vector<Comparison>& rows) {
  const std::vector<glm::ivec2>& at = row.measurement.differing_at;
  if (row.stage != Stage::merge || at.empty() || at.size() < row.measurement.differing) return false;
  const Comparison* winners = nullptr;
  bool by_exact = false;
  for (const Comparison& other : rows) {
    const bool own = other.judge.reference == row.judge.reference && other.judge.kind == row.judge.kind;
    if (own && other.stage == Stage::visibility && other.outcome == Outcome::dispute) winners = &other;
    if (other.stage != row.stage || own) continue;
    if (fails(other)) return false;
    by_exact |= other.judge.kind == Kind::per_stage && holds(other.outcome);
  }
  if (!by_exact || winners == nullptr) return false;
  constexpr auto kRowByRow = [](const glm::ivec2& a, const glm::ivec2& b) {
    return std::pair(a.y, a.x) < std::pair(b.y, b.x);
  };
  std::vector<glm::ivec2> disputed = winners->measurement.differing_at;
  std::ranges::sort(disputed, kRowByRow);
  const auto is_disputed = [&](const glm::ivec2& pixel) {
    return std::ranges::binary_search(disputed, pixel, kRowByRow);
  };
  return std::ranges::all_of(at, is_disputed);
}

}  // namespace

void settle_votes(std::vector<Comparison>& rows, bool plain) {
  std::vector<Comparison*> by_stage;  // a row disputed here no longer fails in later stages' votes
  for (Comparison& row : rows) by_stage.push_back(&row);
  std::ranges::stable_sort(by_stage, {}, &Comparison::stage);
  for (Comparison* each : by_stage) {
    Comparison& row = *each;
    if (!votes(row) || row.outcome != Outcome::different || row.judge.kind == Kind::per_stage) continue;
    if (row.measurement.max_ratio <= 1) continue;  // only the budget of ambiguity is exceeded: no value to contradict
    const std::set<std::string> against = outvoted_by(row, rows, plain ? Stage::visibility : Stage::texture);
    if (against.empty()) continue;
    to_dispute(row, fmt::format("outvoted: the candidate is right by {}, and by exact's arithmetic on its own records",
                                fmt::join(against, " and ")));
  }
  for (Comparison& row : rows) {
    if (row.outcome == Outcome::different && follows_from_winners(row, rows))
      to_dispute(row, "its winners at these pixels are outvoted, see visibility");
  }
}

void leave_recipes_to_exact(std::vector<Comparison>& rows) {
  const auto by_exact = [](const Comparison& row) {
    return row.judge.kind == Kind::per_stage || row.judge.kind == Kind::from_scene;
  };
  for (Comparison& row : rows) {
    if (row.judge.kind != Kind::side_by_side || row.outcome != Outcome::different) continue;
    bool is_judged = false, is_skipped = false, held = true;  // by exact
    for (const Comparison& other : rows) {
      if (other.stage != row.stage || !by_exact(other)) continue;
      is_judged |= holds(other.outcome);
      is_skipped |= other.outcome == Outcome::unsupported;
      held &= !fails(other);
    }
    const bool is_left_open = is_skipped && row.stage > Stage::matrices && row.stage < Stage::coverage;
    if (!held || !(is_judged || is_left_open)) continue;
    row = not_judged(row.scene, row.judge, row.stage, Outcome::unsupported,
                     is_judged ? "the candidate's float arithmetic is not the reference's; exact judges this stage"
                               : "the candidate's float arithmetic is not the reference's; exact alone can judge it");
  }
}

}  // namespace plumbline::check

#include "check/verdict/verdict.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace plumbline::check {

std::string_view name_of(Outcome outcome) {
  constexpr std::array<std::string_view, kOutcomes> kNames = {
      "equal", "within", "ambiguous_only", "different", "dispute", "unsupported", "missing", "failed", "expected"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::string title_of(const JudgeId& judge) {
  constexpr std::array<std::string_view, kKindNames.size()> kHow = {
      "", "", ", from scene", ", per stage", ", at the worst pixels", ", repaired", "", ""};
  return judge.reference + std::string(kHow[static_cast<std::size_t>(judge.kind)]);
}

bool is_failure(Outcome outcome) {
  return outcome == Outcome::different || outcome == Outcome::failed || outcome == Outcome::missing;
}

Comparison judged(std::string scene, JudgeId judge, Stage stage, Measurement m, const Tolerance* tolerance,
                  std::string note) {
  Outcome outcome = Outcome::equal;
  if (m.differing > 0) {
    outcome = Outcome::different;
  } else if (m.disputed > 0) {
    outcome = Outcome::dispute;
  } else if (m.ambiguous > 0) {
    outcome = Outcome::ambiguous_only;
  } else if (m.max_difference > 0) {
    outcome = Outcome::within;
  }
  if (!m.mismatch.empty()) note = m.mismatch;
  return {std::move(scene), std::move(judge), stage,
          outcome,          std::move(m),     tolerance == nullptr ? "" : name_of(*tolerance),
          std::move(note)};
}

void to_dispute(Comparison& c, std::string why) {
  Measurement& m = c.measurement;
  c.outcome = Outcome::dispute;
  m.disputed += std::exchange(m.differing, 0);
  m.dispute = m.worst;
  m.reason = std::move(why);
}

const Worst* shown(const Comparison& c) {
  if (c.outcome == Outcome::dispute) return &c.measurement.dispute;
  return c.measurement.max_difference > 0 ? &c.measurement.worst : nullptr;
}

std::string remark(const Comparison& c) {
  const Worst* worst = shown(c);
  std::string out = worst == nullptr ? "" : to_string(worst->place);
  const auto add = [&](const std::string& more) { out += (out.empty() || more.empty() ? "" : "; ") + more; };
  if (c.outcome == Outcome::dispute) {
    add(fmt::format("{:.9g}, the reference {:.9g}", worst->candidate, worst->reference));
    add(fmt::format("{} disputed: {}", c.measurement.disputed, c.measurement.reason));
  }
  add(c.note);
  return out;
}

Comparison not_judged(std::string scene, JudgeId judge, Stage stage, Outcome outcome, std::string note) {
  return {std::move(scene), std::move(judge), stage, outcome, {}, "", std::move(note)};
}

bool holds(Outcome outcome) {
  return outcome == Outcome::equal || outcome == Outcome::within || outcome == Outcome::ambiguous_only;
}

bool was_compared(const Comparison& row) {
  const bool is_lack =
      row.outcome == Outcome::unsupported || row.outcome == Outcome::missing || row.outcome == Outcome::failed;
  const bool is_known_lack = row.outcome == Outcome::expected && row.measurement.items == 0;
  return !is_lack && !is_known_lack;
}

namespace {

// Bound of the error of attributes over w, and of 1/w, that are stepped in float along the edges and the rows of 1,024
// pixels [u]: a rounding for each step of each. The largest seen of right frames is 1,401, of skywind3000/mini3d.
constexpr double kStepped = 4 * 1024;

// Whether the rows of attributes, texture or shade that differ, if any, do so by no more than kStepped.
bool are_within_steps(const SceneVerdict& verdict, Stage stage) {
  if (stage != Stage::attributes && stage != Stage::texture && stage != Stage::shade) return false;
  return std::ranges::all_of(verdict.comparisons, [&](const Comparison& c) {
    const bool is_stepped = c.measurement.unit == "u" && c.measurement.max_difference <= kStepped;
    return c.stage != stage || c.outcome != Outcome::different || is_stepped;
  });
}

}  // namespace

bool differs_by_steps(const SceneVerdict& verdict, Stage stage) {
  const auto differs = [&](const Comparison& c) { return c.stage == stage && c.outcome == Outcome::different; };
  return std::ranges::any_of(verdict.comparisons, differs) && are_within_steps(verdict, stage);
}

const Comparison* first_beyond_steps(const SceneVerdict& verdict) {
  const Comparison* first = nullptr;
  for (const Comparison& c : verdict.comparisons) {
    if (c.outcome != Outcome::different || (first != nullptr && c.stage >= first->stage)) continue;
    if (!differs_by_steps(verdict, c.stage)) first = &c;
  }
  return first;
}

bool is_legal(const SceneVerdict& verdict, Stage stage) {
  bool legal = false, judged = false;
  for (const Comparison& c : verdict.comparisons) {
    if (c.stage != stage || !judges_legality(c.judge, c.stage)) continue;
    if (is_failure(c.outcome)) return false;
    legal |= holds(c.outcome), judged |= was_compared(c);
  }
  return legal || (!judged && are_within_steps(verdict, stage) && is_legal(verdict, Stage::merge));
}

std::string group_of(std::string_view scene) { return std::string(scene.substr(0, scene.find('/'))); }

bool holds_alone(const SceneVerdict& verdict, Stage stage) {
  return std::ranges::any_of(verdict.comparisons, [&](const Comparison& c) {
    return c.stage == stage && c.judge.kind == Kind::per_stage && holds(c.outcome);
  });
}

const Comparison* first_different(const SceneVerdict& verdict) {
  const Comparison *first = nullptr, *alone = nullptr;
  for (const Comparison& c : verdict.comparisons) {
    if (c.outcome != Outcome::different) continue;
    if (first == nullptr || c.stage < first->stage) first = &c;
    if (c.judge.kind == Kind::per_stage && (alone == nullptr || c.stage < alone->stage)) alone = &c;
  }
  const bool is_alone = alone != nullptr && (alone->stage == first->stage || holds_alone(verdict, first->stage));
  return is_alone ? alone : first;
}

namespace {

bool was_judged(const SceneVerdict& verdict, Stage stage) {
  return std::ranges::any_of(verdict.comparisons,
                             [&](const Comparison& c) { return c.stage == stage && votes(c) && was_compared(c); });
}

}  // namespace

std::vector<Stage> judged_stages(const SceneVerdict& verdict) {
  std::vector<Stage> out;
  for (const Stage stage : kAllStages) {
    if (was_judged(verdict, stage)) out.push_back(stage);
  }
  return out;
}

bool is_by_frame_alone(const SceneVerdict& verdict) {
  return std::ranges::none_of(verdict.comparisons, [](const Comparison& c) {
    return was_compared(c) && c.stage != Stage::depth && c.stage != Stage::merge;
  });
}

bool is_open(const SceneVerdict& verdict) {
  std::size_t rows = 0, open = 0, colors = 0, open_colors = 0;
  for (const Comparison& c : verdict.comparisons) {
    if (!votes(c) || !was_compared(c)) continue;
    const Measurement& m = c.measurement;
    const bool is_all = m.items > 0 && m.ambiguous >= m.items, is_color = c.stage == Stage::merge;
    const bool is_ambiguous = c.outcome == Outcome::ambiguous_only;
    ++rows;
    open += is_ambiguous && (is_all || verdict.empty_holds) ? 1 : 0;
    colors += is_color ? 1 : 0;
    open_colors += is_color && is_ambiguous && (is_all || verdict.knows_no_color) ? 1 : 0;
  }
  return rows > 0 && (open == rows || (colors > 0 && open_colors == colors));
}

bool is_judged(const SceneVerdict& verdict) { return !judged_stages(verdict).empty() && !is_open(verdict); }

bool any_judged(std::span<const SceneVerdict> verdicts) { return std::ranges::any_of(verdicts, is_judged); }

std::string judged_text(const SceneVerdict& verdict) {
  std::vector<std::pair<std::string, std::string>> lacking;  // a reason, and its stages
  for (const Stage stage : kAllStages) {
    if (was_judged(verdict, stage)) continue;
    const auto row = std::ranges::find_if(
        verdict.comparisons, [&](const Comparison& c) { return c.stage == stage && votes(c) && !c.note.empty(); });
    const std::string reason = row == verdict.comparisons.end() ? "not in this scene" : row->note;
    const auto known = std::ranges::find(lacking, reason, &std::pair<std::string, std::string>::first);
    if (known != lacking.end()) {
      known->second += fmt::format(", {}", name_of(stage));
    } else {
      lacking.emplace_back(reason, name_of(stage));
    }
  }
  std::string out = fmt::format("{} of {} stages judged\n", judged_stages(verdict).size(), kStageNames.size());
  for (const auto& [reason, stages] : lacking) out += fmt::format("  not judged: {}: {}\n", stages, reason);
  return out;
}

std::vector<Stage> unjudged_stages(const SceneVerdict& verdict) {
  std::vector<Stage> out;
  for (const Stage stage : kAllStages) {
    // Nobody says anything of a stage that the scene does not have.
    const bool is_asked =
        row_of(stage).in_scene == nullptr ||
        std::ranges::find(verdict.comparisons, stage, &Comparison::stage) != verdict.comparisons.end();
    if (is_asked && !was_judged(verdict, stage)) out.push_back(stage);
  }
  return out;
}

std::vector<Stage> stages_lost_to_missing(const SceneVerdict& verdict) {
  const auto is = [&](Outcome outcome) { return [=](const Comparison& c) { return c.outcome == outcome; }; };
  if (std::ranges::none_of(verdict.comparisons, is(Outcome::missing))) return {};
  std::vector<Stage> out = unjudged_stages(verdict);
  std::erase_if(out, [&](Stage stage) {
    return std::ranges::any_of(verdict.comparisons, [&](const Comparison& c) {
      return c.stage == stage && (c.outcome == Outcome::unsupported || c.outcome == Outcome::failed);
    });
  });
  return out;
}

std::vector<LedgerUse> ledger_use(std::span<const SceneVerdict> verdicts) {
  std::vector<LedgerUse> uses;
  for (const Tolerance& row : ledger()) uses.push_back({&row, -1, ""});
  for (const SceneVerdict& verdict : verdicts) {
    for (const Comparison& c : verdict.comparisons) {
      if (c.outcome == Outcome::dispute) continue;  // the reference's fault, where it is a small one too
      for (LedgerUse& use : uses) {
        const std::string name = name_of(*use.row);
        if (c.ledger_row != name || c.measurement.max_ratio <= use.largest_ratio) continue;
        use.largest_ratio = c.measurement.max_ratio;
        use.where = fmt::format("{}, {}, {}", c.scene, title_of(c.judge), to_string(c.measurement.worst.place));
      }
    }
  }
  return uses;
}

}  // namespace plumbline::check

#include "report/text/table.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumbline::report {

using check::Comparison;
using check::Outcome;
using check::SceneVerdict;

namespace {

constexpr const char* kRow = "{:<28} {:<24} {:<10} {:<14} {:>9} {:>9} {:>9}  {:<24} {}\n";

// Upper limit of tolerances that allow for float's underflow alone [any unit].
constexpr double kOfUnderflow = 1e-30;

std::string largest(const Comparison& c) {
  const check::Worst* worst = check::shown(c);
  if (worst == nullptr) return "0";
  const bool is_of_underflow = worst->tolerance > 0 && worst->tolerance < kOfUnderflow;
  const std::string tolerance = is_of_underflow ? "underflow" : fmt::format("{:.4g}", worst->tolerance);
  return fmt::format("{:.4g} {} (tolerance {})", worst->difference, c.measurement.unit, tolerance);
}

// A row is a line; failure_lines() has all of it.
std::string first_line(const std::string& note) { return note.substr(0, note.find('\n')); }

// Stages that c's judge did not compare, with c's outcome and reason; c's stage included.
std::vector<std::string_view> not_compared_as(const Comparison& c, const SceneVerdict& verdict) {
  std::vector<std::string_view> out;
  for (const Comparison& other : verdict.comparisons) {
    if (check::was_compared(other) || other.outcome != c.outcome || title_of(other.judge) != title_of(c.judge) ||
        first_line(other.note) != first_line(c.note))
      continue;
    out.push_back(name_of(other.stage));
  }
  return out;
}

// Stages other than `first` that are wrong on the candidate's own records of the stages before.
std::vector<std::string_view> others_wrong(const SceneVerdict& verdict, Stage first) {
  std::vector<std::string_view> out;
  for (const Comparison& c : verdict.comparisons) {
    const bool is_wrong = c.judge.kind == check::Kind::per_stage && c.outcome == Outcome::different;
    if (is_wrong && c.stage != first && std::ranges::find(out, name_of(c.stage)) == out.end())
      out.push_back(name_of(c.stage));
  }
  return out;
}

}  // namespace

std::string table_head() {
  return fmt::format(kRow, "scene", "reference", "stage", "outcome", "pixels", "differing", "ambiguous", "largest",
                     "worst");
}

std::string table_rows(const SceneVerdict& verdict) {
  std::string out;
  for (const Comparison& c : verdict.comparisons) {
    const check::Measurement& m = c.measurement;
    if (check::was_compared(c)) {
      out += fmt::format(kRow, c.scene, title_of(c.judge), name_of(c.stage), name_of(c.outcome), m.items, m.differing,
                         m.ambiguous, largest(c), check::remark(c));
      continue;
    }
    const std::vector<std::string_view> stages = not_compared_as(c, verdict);
    if (stages.front() != name_of(c.stage)) continue;  // in the first one's row
    const std::string note = first_line(c.note);
    const bool alone = stages.size() == 1;
    out += fmt::format(kRow, c.scene, title_of(c.judge), alone ? stages[0] : fmt::format("{} stages", stages.size()),
                       name_of(c.outcome), "-", "-", "-", "-",
                       alone ? note : fmt::format("{} ({})", fmt::join(stages, ", "), note));
  }
  return out;
}

std::string failure_lines(const SceneVerdict& verdict, std::span<const Stage> unjudged,
                          const std::string& repeat_command) {
  std::string out;
  const auto& rows = verdict.comparisons;
  for (auto c = rows.begin(); c != rows.end(); ++c) {
    if (c->outcome != Outcome::failed && c->outcome != Outcome::missing) continue;
    const auto is_same = [&](const Comparison& other) {
      return other.outcome == c->outcome && other.stage == c->stage && other.note == c->note;
    };
    if (std::any_of(rows.begin(), c, is_same)) continue;  // in the first one's line
    std::vector<std::string> judges;
    for (const Comparison& same : rows) {
      if (is_same(same)) judges.push_back(title_of(same.judge));
    }
    out += fmt::format("{} {}: {}, {}: {}\n", name_of(c->outcome), c->scene, fmt::join(judges, "; "), name_of(c->stage),
                       c->note);
  }
  for (Stage stage : unjudged) {
    out += fmt::format("unjudged {}: no reference judged {}\n", verdict.scene, name_of(stage));
  }
  if (const Comparison* first = check::first_different(verdict)) {
    const check::Worst& w = first->measurement.worst;
    out += fmt::format("different {}: first different stage: {} (against {}){}: {} of {} beyond tolerance",
                       first->scene, name_of(first->stage), title_of(first->judge),
                       check::is_by_frame_alone(verdict) ? ", or an earlier one" : "", first->measurement.differing,
                       first->measurement.items);
    if (!first->note.empty()) out += "; " + first->note;
    if (w.difference > 0) {
      const bool legal = check::judges_legality(first->judge, first->stage);
      out += "\n  worst: " + check::to_string(w, legal ? "nearest legal" : "the reference", first->measurement.unit);
    }
    if (const auto others = others_wrong(verdict, first->stage); !others.empty())
      out += fmt::format("\n  wrong by themselves{}: {}; plumb diagnose tells which one the picture shows",
                         first->judge.kind == check::Kind::per_stage ? ", too" : "", fmt::join(others, ", "));
    out += '\n';
  }
  if (!out.empty()) out += fmt::format("  repeat: {}\n", repeat_command);
  return out;
}

namespace {

// How many comparisons came to what.
struct Tally {
  std::array<std::size_t, check::kOutcomes> of_outcome{};
  std::size_t scenes = 0, comparisons = 0;

  void add(const SceneVerdict& verdict) {
    ++scenes;
    comparisons += verdict.comparisons.size();
    for (const Comparison& c : verdict.comparisons) ++of_outcome[static_cast<std::size_t>(c.outcome)];
  }
  std::size_t count(Outcome outcome) const { return of_outcome[static_cast<std::size_t>(outcome)]; }
  std::string text() const {
    std::string out;
    for (std::size_t i = 0; i < of_outcome.size(); ++i) {
      if (of_outcome[i] == 0) continue;
      out += fmt::format("{}{} {}", out.empty() ? "" : ", ", of_outcome[i], name_of(static_cast<Outcome>(i)));
    }
    return out;
  }
};

}  // namespace

std::string scene_line(const SceneVerdict& verdict) {
  Tally tally;
  tally.add(verdict);
  const char* word = check::is_judged(verdict) ? "holds" : "not judged";
  return fmt::format("{:<28} {}: {}\n", verdict.scene, word, tally.text());
}

std::string group_lines(std::span<const SceneVerdict> verdicts) {
  std::map<std::string, Tally> groups;
  for (const SceneVerdict& verdict : verdicts) groups[check::group_of(verdict.scene)].add(verdict);
  std::string out;
  for (const auto& [group, tally] : groups) {
    out += fmt::format("{:<16} {:>4} scenes {:>6} comparisons: {}\n", group, tally.scenes, tally.comparisons,
                       tally.text());
  }
  return out;
}

std::string summary(std::span<const SceneVerdict> verdicts, bool all_hold, double seconds) {
  Tally tally;
  bool complete = true;
  for (const SceneVerdict& verdict : verdicts) {
    tally.add(verdict);
    complete &= check::unjudged_stages(verdict).empty();
  }
  for (Outcome outcome : {Outcome::unsupported, Outcome::missing, Outcome::dispute, Outcome::expected}) {
    complete &= tally.count(outcome) == 0;
  }
  const char* word = !all_hold                      ? "FAILED"
                     : !check::any_judged(verdicts) ? "nothing was judged"
                     : complete                     ? "ok"
                                                    : "ok where judged";
  return fmt::format("{}: {} scenes, {} comparisons in {:.2f} s: {}\n", word, tally.scenes, tally.comparisons, seconds,
                     tally.text());
}

std::string stored_table(std::span<const check::StoredComparison> comparisons, double tolerance) {
  constexpr const char* kStoredRow = "{:<24} {:<10} {:>9} {:>9}  {:<24} {}\n";
  std::string out = fmt::format(kStoredRow, "what", "outcome", "items", "differing", "largest", "worst");
  for (const check::StoredComparison& c : comparisons) {
    const check::Measurement& m = c.measurement;
    if (c.outcome == Outcome::missing) {
      out += fmt::format(kStoredRow, c.what, name_of(c.outcome), "-", "-", "-", c.note);
      continue;
    }
    std::string size = "0", place;
    if (m.max_difference > 0) {
      size = fmt::format("{:.4g}", m.max_difference);
      if (c.codes > 0) size += fmt::format(" ({:.6g}/{:.0f})", m.max_difference * c.codes, c.codes);
    }
    if (m.max_difference > 0 && m.mismatch.empty()) {
      place = fmt::format("{}: {:.9g} against {:.9g}", check::to_string(m.worst.place), m.worst.candidate,
                          m.worst.reference);
    }
    const char* between = place.empty() || c.note.empty() ? "" : "; ";
    out += fmt::format(kStoredRow, c.what, name_of(c.outcome), m.items, m.differing, size, place + between + c.note);
  }
  std::size_t differ = 0, missing = 0;
  for (const check::StoredComparison& c : comparisons) {
    differ += c.outcome == Outcome::different ? 1 : 0;
    missing += c.outcome == Outcome::missing ? 1 : 0;
  }
  const auto first = std::ranges::find(comparisons, Outcome::different, &check::StoredComparison::outcome);
  if (comparisons.size() == missing) {
    out += "nothing was compared\n";
  } else if (first != comparisons.end()) {
    out += fmt::format("different: {} of {} beyond tolerance {}; first: {}\n", differ, comparisons.size(), tolerance,
                       first->what);
  } else {
    out += fmt::format("{} of {} hold, tolerance {}\n", comparisons.size() - missing, comparisons.size(), tolerance);
  }
  return out;
}

}  // namespace plumbline::report

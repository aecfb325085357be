#include "report/text/conformance.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "report/text/markdown.h"

namespace plumbline::report {

namespace {

constexpr std::string_view kProgram = "program";  // the name of a --program

using Counts = std::map<std::string, std::size_t>;

std::vector<std::pair<std::string, std::size_t>> by_count(const Counts& counts) {
  std::vector<std::pair<std::string, std::size_t>> out(counts.begin(), counts.end());
  std::ranges::stable_sort(out, std::ranges::greater(), &std::pair<std::string, std::size_t>::second);
  return out;
}

// Whether the program refused the scene. Its reason stands in a row of its own, the first of an antialiased scene's
// passes.
bool is_refused_by_program(const check::SceneVerdict& verdict) {
  return !verdict.comparisons.empty() && verdict.comparisons.front().judge.reference == kProgram;
}

std::string counted(const std::vector<std::pair<std::string, std::size_t>>& counts) {
  std::vector<std::string> words;
  for (const auto& [word, count] : counts) words.push_back(fmt::format("{} {}", word, count));
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace

std::string unable_reason(const check::SceneVerdict& verdict) {
  if (is_refused_by_program(verdict)) return verdict.comparisons.front().note;
  if (!check::is_open(verdict)) return "nothing that it left could be judged";
  return verdict.empty_holds ? "a frame in which nothing is drawn holds, too"
                             : "every colour of a surface has several legal answers";
}

const check::Comparison* first_wrong(const check::SceneVerdict& verdict) {
  const check::Comparison* first = nullptr;
  for (const check::Comparison& c : verdict.comparisons) {
    const bool wrong = c.outcome == check::Outcome::different && !check::is_legal(verdict, c.stage);
    if (wrong && (first == nullptr || c.stage < first->stage)) first = &c;
  }
  const check::Comparison* by_itself = check::first_different(verdict);
  const bool is_cause = first != nullptr && by_itself->judge.kind == check::Kind::per_stage &&
                        by_itself->stage != Stage::coverage;  // exact's tie rule need not be the program's
  return is_cause ? by_itself : first;
}

bool is_right(const check::SceneVerdict& verdict, Stage stage) {
  bool holds = false;
  for (const check::Comparison& row : verdict.comparisons) {
    if (row.stage != stage || !check::votes(row)) continue;
    if (check::is_failure(row.outcome)) return false;
    holds = holds || row.outcome == check::Outcome::equal || row.outcome == check::Outcome::within;
  }
  return holds;
}

Conformance conformance_of(const check::SceneVerdict& verdict) {
  const auto any = [&](auto holds) { return std::ranges::any_of(verdict.comparisons, holds); };
  if (first_wrong(verdict) != nullptr) return Conformance::differs;
  if (any([](const check::Comparison& c) { return c.outcome == check::Outcome::failed; })) return Conformance::failed;
  if (any([](const check::Comparison& c) { return c.outcome == check::Outcome::expected; })) return Conformance::known;
  if (!check::is_judged(verdict)) return Conformance::unable;
  return check::first_different(verdict) != nullptr ? Conformance::legal : Conformance::holds;
}

std::vector<FeatureTally> conformance(std::span<const check::SceneVerdict> verdicts) {
  std::map<std::string, FeatureTally> tallies;
  std::map<std::string, Counts> wrong;
  for (const check::SceneVerdict& verdict : verdicts) {
    FeatureTally& tally = tallies[check::group_of(verdict.scene)];
    switch (conformance_of(verdict)) {
      case Conformance::holds: ++tally.holds; break;
      case Conformance::legal: ++tally.legal; break;
      case Conformance::known: ++tally.known; break;
      case Conformance::failed: ++tally.failed; break;
      case Conformance::unable: ++tally.unable; break;
      case Conformance::differs:
        ++tally.differs;
        ++wrong[check::group_of(verdict.scene)][std::string(name_of(first_wrong(verdict)->stage))];
    }
  }
  std::vector<FeatureTally> out;
  for (auto& [feature, tally] : tallies) {
    tally.feature = feature;
    tally.first_wrong = by_count(wrong[feature]);
    out.push_back(std::move(tally));
  }
  return out;
}

FeatureTally whole_suite(std::span<const check::SceneVerdict> verdicts) {
  FeatureTally all;
  Counts wrong;
  for (const FeatureTally& t : conformance(verdicts)) {
    all.holds += t.holds, all.legal += t.legal, all.known += t.known, all.differs += t.differs, all.failed += t.failed,
        all.unable += t.unable;
    for (const auto& [stage, count] : t.first_wrong) wrong[stage] += count;
  }
  all.feature = "all";
  all.first_wrong = by_count(wrong);
  return all;
}

namespace {

// All features, the whole suite last.
std::vector<FeatureTally> with_all(std::span<const check::SceneVerdict> verdicts) {
  std::vector<FeatureTally> out = conformance(verdicts);
  out.push_back(whole_suite(verdicts));
  return out;
}

// Whether the program showed its frame, and no record, where it is wrong.
bool is_wrong_by_frame(const check::SceneVerdict& verdict) {
  return conformance_of(verdict) == Conformance::differs && check::is_by_frame_alone(verdict);
}

// Line on scenes of which the frame alone was judged and is wrong: an earlier stage may be. Empty: none.
std::string frame_line(std::span<const check::SceneVerdict> verdicts) {
  const auto count = std::ranges::count_if(verdicts, is_wrong_by_frame);
  if (count == 0) return "";
  return fmt::format(
      "judged by the frame alone, wrong at the stage named or an earlier one: {} (--each-primitive shows coverage and "
      "visibility)\n",
      count);
}

// Line on stages that are wrong by themselves, beside each scene's first wrong one. Empty: none.
std::string further_line(std::span<const check::SceneVerdict> verdicts) {
  Counts scenes;
  for (const check::SceneVerdict& verdict : verdicts) {
    const check::Comparison* first = first_wrong(verdict);
    if (first == nullptr) continue;
    std::set<Stage> further;
    for (const check::Comparison& c : verdict.comparisons) {
      const bool is_wrong = c.outcome == check::Outcome::different && check::judges_alone(c);
      if (is_wrong && c.stage != first->stage && !check::is_legal(verdict, c.stage)) further.insert(c.stage);
    }
    for (const Stage stage : further) ++scenes[std::string(name_of(stage))];
  }
  return scenes.empty() ? ""
                        : fmt::format("wrong by itself beside the first wrong stage: {}\n", counted(by_count(scenes)));
}

// Line on scenes that are right or legal, and whose colour or depth no reference judged. Empty: there are none.
std::string not_judged_line(std::span<const check::SceneVerdict> verdicts) {
  Counts scenes;
  for (const check::SceneVerdict& verdict : verdicts) {
    const Conformance ended = conformance_of(verdict);
    if (ended != Conformance::holds && ended != Conformance::legal) continue;
    const auto judged = [&](std::initializer_list<Stage> stages) {
      return std::ranges::any_of(verdict.comparisons, [&](const check::Comparison& c) {
        return check::votes(c) && check::was_compared(c) && std::ranges::find(stages, c.stage) != stages.end();
      });
    };
    if (!judged({Stage::merge, Stage::resolve})) ++scenes["colour"];
    if (!judged({Stage::depth})) ++scenes["depth"];
  }
  return scenes.empty() ? "" : fmt::format("right or legal, and not judged: {}\n", counted(by_count(scenes)));
}

// Cause of the scene that `scenes` counts in most scenes; "A, or B", up to three, of equals. Empty: none is known.
std::string likeliest(const check::SceneVerdict& verdict, const Counts& scenes) {
  constexpr std::size_t kShown = 3;
  std::size_t most = 0;
  for (const std::string& cause : verdict.causes) most = std::max(most, scenes.at(cause));
  std::vector<std::string> out;
  for (const std::string& cause : verdict.causes) {
    if (scenes.at(cause) == most && out.size() < kShown) out.push_back(cause);
  }
  return fmt::format("{}", fmt::join(out, ", or "));
}

// One cause of many scenes is one line.
std::string cause_lines(std::span<const check::SceneVerdict> verdicts) {
  Counts possible, causes;
  for (const check::SceneVerdict& verdict : verdicts) {
    for (const std::string& cause : verdict.causes) ++possible[cause];
  }
  std::map<std::string, std::string> first;
  std::size_t unknown = 0;
  for (const check::SceneVerdict& verdict : verdicts) {
    const Conformance ended = conformance_of(verdict);
    if (ended != Conformance::differs && ended != Conformance::failed) continue;
    const std::string cause = likeliest(verdict, possible);
    if (cause.empty()) {
      unknown += ended == Conformance::differs ? 1 : 0;
      continue;
    }
    const bool is_fault = cause.ends_with(')');
    const char* how = ended == Conformance::failed ? "failed, and" : is_fault ? "wrong as by" : "wrong, and";
    const std::string line = fmt::format("{} {}", how, cause);
    if (++causes[line] == 1) first[line] = verdict.scene;
  }
  std::string out;
  for (const auto& [line, count] : by_count(causes)) out += fmt::format("{}: {}, first {}\n", line, count, first[line]);
  return unknown == 0 ? out : out + fmt::format("wrong, and no known fault matches: {}\n", unknown);
}

// Lines on scenes that are unable, one for each of the most frequent reasons. Scenes that the program did not refuse are
// named, up to ten.
std::string unable_lines(std::span<const check::SceneVerdict> verdicts) {
  constexpr std::size_t kNamed = 10, kReasons = 12;
  Counts reasons;
  std::map<std::string, std::vector<std::string>> named;
  for (const check::SceneVerdict& verdict : verdicts) {
    if (conformance_of(verdict) != Conformance::unable) continue;
    const std::string reason = unable_reason(verdict);
    ++reasons[reason];
    if (!is_refused_by_program(verdict)) named[reason].push_back(verdict.scene);
  }
  std::string out;
  std::size_t shown = 0, others = 0;
  for (const auto& [reason, count] : by_count(reasons)) {
    if (shown++ >= kReasons) {
      others += count;
      continue;
    }
    out += fmt::format("unable: {} {}", reason, count);
    const std::vector<std::string>& scenes = named[reason];
    if (!scenes.empty())
      out += fmt::format(" ({}{})", fmt::join(std::span(scenes).first(std::min(scenes.size(), kNamed)), ", "),
                         scenes.size() > kNamed ? ", ..." : "");
    out += "\n";
  }
  if (others > 0) out += fmt::format("unable: for {} other reasons {} (--verbose)\n", shown - kReasons, others);
  return out;
}

}  // namespace

std::string conformance_text(std::span<const check::SceneVerdict> verdicts) {
  constexpr const char* kRow = "{:<16} {:>6} {:>7} {:>7} {:>7} {:>7} {:>7}  {}\n";
  std::string out =
      fmt::format(kRow, "feature", "right", "legal", "known", "wrong", "failed", "unable", "first wrong stage");
  for (const FeatureTally& t : with_all(verdicts)) {
    out +=
        fmt::format(kRow, t.feature, t.holds, t.legal, t.known, t.differs, t.failed, t.unable, counted(t.first_wrong));
  }
  return out + unable_lines(verdicts) + not_judged_line(verdicts) + further_line(verdicts) + frame_line(verdicts) +
         cause_lines(verdicts);
}

std::string conformance_markdown(std::span<const check::SceneVerdict> verdicts) {
  std::string out =
      "\n## Scenes by feature\n\n| feature | right | legal | known | wrong | failed | unable | first wrong stage |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const FeatureTally& t : with_all(verdicts)) {
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", cell(t.feature), t.holds, t.legal, t.known,
                       t.differs, t.failed, t.unable, cell(counted(t.first_wrong)));
  }
  return out + "\n" + cell(unable_lines(verdicts) + not_judged_line(verdicts)) + "\n\n" +
         cell(further_line(verdicts) + frame_line(verdicts) + cause_lines(verdicts)) + "\n";
}

}  // namespace plumbline::report

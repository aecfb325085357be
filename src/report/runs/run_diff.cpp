#include "report/runs/run_diff.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "report/text/markdown.h"

namespace plumbline::report {

namespace {

using check::Comparison;
using check::Outcome;
using check::SceneVerdict;

// Inserts under `key`, or under "key (2)", "key (3)", ... where it is taken.
template <class Value>
void insert(std::map<std::string, Value>& map, std::string key, Value value) {
  std::string free = key;
  for (int i = 2; !map.try_emplace(free, value).second; ++i) free = fmt::format("{} ({})", key, i);
}

std::map<std::string, const SceneVerdict*> scenes_of(const CheckRun& run) {
  std::map<std::string, const SceneVerdict*> out;
  for (const SceneVerdict& verdict : run.verdicts) insert(out, verdict.scene, &verdict);
  return out;
}

std::map<std::string, const Comparison*> rows_of(const CheckRun& run) {
  std::map<std::string, const Comparison*> out;
  for (const SceneVerdict& verdict : run.verdicts) {
    for (const Comparison& c : verdict.comparisons) {
      insert(out, fmt::format("{}, {}, {}", c.scene, title_of(c.judge), name_of(c.stage)), &c);
    }
  }
  return out;
}

std::string text(const Comparison& c) {
  const check::Worst* worst = check::shown(c);
  if (worst == nullptr || c.outcome != Outcome::different) return std::string(name_of(c.outcome));
  return fmt::format("different: {} of {}, largest {:.4g} {}", c.measurement.differing, c.measurement.items,
                     worst->difference, c.measurement.unit);
}

bool beyond(double was, double now, double factor) {
  return !(was <= now * factor && now <= was * factor) && !(std::isnan(was) && std::isnan(now)) && was != now;
}

bool moved(const check::Measurement& was, const check::Measurement& now, double factor) {
  const auto counts = [&](std::uint64_t a, std::uint64_t b) {
    return beyond(static_cast<double>(a), static_cast<double>(b), factor);
  };
  return beyond(was.max_difference, now.max_difference, factor) || counts(was.differing, now.differing) ||
         counts(was.ambiguous, now.ambiguous) || counts(was.disputed, now.disputed);
}

std::string size(const check::Measurement& m) {
  const std::string disputed = m.disputed > 0 ? fmt::format("{} disputed, ", m.disputed) : "";
  return fmt::format("{} differ, {} ambiguous, {}largest {:.4g} {}", m.differing, m.ambiguous, disputed,
                     m.max_difference, m.unit);
}

void add_row(RunDiff& out, const std::string& what, const Comparison& was, const Comparison& now,
             const DiffLimits& limits) {
  const Change change{what, text(was), text(now)};
  const bool failed = is_failure(was.outcome), fails = is_failure(now.outcome);
  if (fails && !failed) {
    out.broken.push_back(change);
  } else if (was_compared(was) && !was_compared(now)) {
    out.lost.push_back(change);
  } else if (now.outcome == Outcome::expected && was.outcome != Outcome::expected) {
    out.excused.push_back(change);
  } else if ((failed || was.outcome == Outcome::expected) && check::holds(now.outcome)) {
    out.fixed.push_back(change);
  } else if (was.outcome != now.outcome) {
    out.moved.push_back(change);
  } else if (moved(was.measurement, now.measurement, limits.factor)) {
    out.differences.push_back({what, size(was.measurement), size(now.measurement)});
  }
}

// Failures of a scene that are in none of its rows: an unjudged stage, an expectation no longer met.
// `was`: null where the earlier run has no such scene.
void add_scene(RunDiff& out, const std::string& what, const SceneVerdict* was, const SceneVerdict& now) {
  const auto by_row = [](const SceneVerdict& v) {
    return std::ranges::any_of(v.comparisons, [](const Comparison& c) { return is_failure(c.outcome); });
  };
  const auto first_line = [](const SceneVerdict& v) {
    return v.failure.empty() ? "holds" : v.failure.substr(0, v.failure.find('\n'));
  };
  const bool failed = was != nullptr && !was->failure.empty();
  if (!failed && !now.failure.empty() && !by_row(now))
    out.broken.push_back({what, was != nullptr ? "holds" : "not there", first_line(now)});
  if (failed && now.failure.empty() && !by_row(*was)) out.fixed.push_back({what, first_line(*was), "holds"});
}

using Kind = std::pair<std::string_view, const std::vector<Change>*>;
std::vector<Kind> kinds(const RunDiff& d) {
  return {{"newly broken", &d.broken},
          {"not judged any more", &d.lost},
          {"newly expected to differ", &d.excused},
          {"newly fixed", &d.fixed},
          {"other outcome", &d.moved},
          {"added", &d.added},
          {"gone", &d.gone},
          {"tolerances that moved", &d.tolerances},
          {"differences that moved", &d.differences},
          {"times that moved", &d.times},
          {"versions", &d.versions}};
}

}  // namespace

RunDiff diff(const CheckRun& before, const CheckRun& now, const DiffLimits& limits) {
  RunDiff out;
  const auto old_rows = rows_of(before), rows = rows_of(now);
  for (const auto& [what, was] : old_rows) {
    const auto found = rows.find(what);
    if (found != rows.end()) {
      add_row(out, what, *was, *found->second, limits);
    } else {
      (was_compared(*was) ? out.lost : out.gone).push_back({what, text(*was), "not there"});
    }
  }
  for (const auto& [what, row] : rows) {
    if (!old_rows.contains(what)) {
      (is_failure(row->outcome) ? out.broken : out.added).push_back({what, "not there", text(*row)});
    }
  }
  const auto old_scenes = scenes_of(before), scenes = scenes_of(now);
  for (const auto& [what, verdict] : scenes) {
    const auto found = old_scenes.find(what);
    const SceneVerdict* was = found == old_scenes.end() ? nullptr : found->second;
    add_scene(out, what, was, *verdict);
    if (was == nullptr) continue;
    if (beyond(was->seconds, verdict->seconds, limits.slower) &&
        std::abs(was->seconds - verdict->seconds) >= limits.at_least_s) {
      out.times.push_back({what, fmt::format("{:.2f} s", was->seconds), fmt::format("{:.2f} s", verdict->seconds)});
    }
  }
  for (const std::string& line : now.head.failures) {
    if (std::ranges::count(before.head.failures, line) == 0) out.broken.push_back({"the run", "holds", line});
  }
  const auto of = [](const auto& map, const std::string& key) {
    const auto found = map.find(key);
    return found == map.end() ? std::string("not there") : fmt::format("{}", found->second);
  };
  const auto compare = [&](const auto& a, const auto& b, std::vector<Change>& changes) {
    std::set<std::string> keys;
    for (const auto& [key, value] : a) keys.insert(key);
    for (const auto& [key, value] : b) keys.insert(key);
    for (const std::string& key : keys) {
      if (of(a, key) != of(b, key)) changes.push_back({key, of(a, key), of(b, key)});
    }
  };
  const std::map<std::string, std::string> was_asked = {
      {"fault", before.head.fault}, {"references", fmt::format("{}", fmt::join(before.head.against, ","))}};
  const std::map<std::string, std::string> is_asked = {
      {"fault", now.head.fault}, {"references", fmt::format("{}", fmt::join(now.head.against, ","))}};
  compare(was_asked, is_asked, out.versions);
  compare(before.tolerances, now.tolerances, out.tolerances);
  compare(before.head.versions, now.head.versions, out.versions);
  return out;
}

bool holds(const RunDiff& d) { return d.broken.empty() && d.lost.empty(); }

std::string diff_text(const RunDiff& d) {
  std::string out;
  for (const auto& [kind, changes] : kinds(d)) {
    if (changes->empty()) continue;
    out += fmt::format("{}: {}\n", kind, changes->size());
    for (const Change& c : *changes) out += fmt::format("  {}: {} -> {}\n", c.what, c.was, c.now);
  }
  return out.empty() ? "nothing has changed\n" : out;
}

std::string diff_markdown(const RunDiff& d) {
  constexpr std::size_t kMost = 200;  // a CI page takes 1 MiB
  std::string out = fmt::format("## plumb report diff: {}\n", holds(d) ? "holds" : "FAILED");
  for (const auto& [kind, changes] : kinds(d)) {
    if (changes->empty()) continue;
    out += fmt::format("\n### {}: {}\n\n| what | was | now |\n|---|---|---|\n", kind, changes->size());
    for (std::size_t i = 0; i < std::min(kMost, changes->size()); ++i) {
      const Change& c = (*changes)[i];
      out += fmt::format("| {} | {} | {} |\n", cell(c.what), cell(c.was), cell(c.now));
    }
    if (changes->size() > kMost) out += fmt::format("\nand {} more\n", changes->size() - kMost);
  }
  return out;
}

std::string diff_json(const RunDiff& d) {
  nlohmann::ordered_json out{{"holds", holds(d)}};
  for (const auto& [kind, changes] : kinds(d)) {
    nlohmann::ordered_json& list = out[std::string(kind)] = nlohmann::ordered_json::array();
    for (const Change& c : *changes) list.push_back({{"what", c.what}, {"was", c.was}, {"now", c.now}});
  }
  return out.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace plumbline::report

#include "report/runs/run_merge.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumbline::report {

namespace {

using check::Comparison;
using check::SceneVerdict;

// Numbers as text: NaN equals itself here.
bool same(const Comparison& a, const Comparison& b) {
  const check::Measurement &m = a.measurement, &n = b.measurement;
  const auto numbers = [](const check::Measurement& x) {
    return fmt::format("{} {} {} {} {} {}", x.items, x.differing, x.ambiguous, x.disputed, x.max_difference,
                       x.max_ratio);
  };
  return a.judge == b.judge && a.stage == b.stage && a.outcome == b.outcome && a.note == b.note &&
         numbers(m) == numbers(n) && m.histogram == n.histogram;
}

bool same(const SceneVerdict& a, const SceneVerdict& b) {
  return a.failure.empty() == b.failure.empty() &&
         std::ranges::equal(a.comparisons, b.comparisons,
                            [](const Comparison& x, const Comparison& y) { return same(x, y); });
}

void require_one_run(const CheckRun& first, const CheckRun& other) {
  const auto refuse = [&](std::string_view what) {
    throw std::runtime_error(fmt::format("{} and {} are not of one run: {}", first.file, other.file, what));
  };
  const RunHead &a = first.head, &b = other.head;
  if (a.versions != b.versions) refuse("their versions differ");
  if (a.fault != b.fault) refuse(fmt::format("of a renderer with the fault '{}' and '{}'", a.fault, b.fault));
  if (a.against != b.against || a.golden != b.golden) refuse("other references were asked");
  if (first.tolerances != other.tolerances) refuse("their tolerances differ");
  if (a.shard.of != b.shard.of) refuse(fmt::format("shards of {} and of {}", a.shard.of, b.shard.of));
  if (a.shard.of > 1 && a.shard.scenes != b.shard.scenes) {
    refuse(fmt::format("of {} scenes and of {}", a.shard.scenes, b.shard.scenes));
  }
}

void require_these_tolerances(const CheckRun& run) {
  std::map<std::string, double> ours;
  for (const check::Tolerance& row : check::ledger()) ours[name_of(row)] = row.factor;
  if (ours != run.tolerances) {
    throw std::runtime_error(
        fmt::format("{}: its tolerances are not this program's: another version wrote it", run.file));
  }
}

}  // namespace

Merged merge(std::vector<CheckRun> runs) {
  Merged out;
  CheckRun& all = out.run;
  all.head = runs.front().head;
  all.head.shard = {};
  all.tolerances = runs.front().tolerances;
  require_these_tolerances(runs.front());
  std::map<std::string, std::pair<const SceneVerdict*, const CheckRun*>> by_file;
  std::set<int> there;
  for (const CheckRun& run : runs) {
    require_one_run(runs.front(), run);
    there.insert(run.head.shard.index);
    for (const std::string& line : run.head.failures) {
      if (std::ranges::count(all.head.failures, line) == 0) all.head.failures.push_back(line);
    }
    for (const SceneVerdict& verdict : run.verdicts) {
      const auto [at, is_new] = by_file.try_emplace(verdict.path, &verdict, &run);
      if (!is_new && !same(*at->second.first, verdict)) {
        throw std::runtime_error(fmt::format("{}: twice, with results that differ, in {} and {}", verdict.path,
                                             at->second.second->file, run.file));
      }
    }
  }
  for (const auto& [file, found] : by_file) {
    SceneVerdict& verdict = all.verdicts.emplace_back(*found.first);
    for (Comparison& c : verdict.comparisons) {
      for (check::Worst* worst : {&c.measurement.worst, &c.measurement.dispute}) {
        worst->place.field = all.words.insert(worst->place.field).first->c_str();
      }
    }
  }
  const Shard& of_any = runs.front().head.shard;
  all.head.shard.scenes = of_any.of > 1 ? of_any.scenes : all.verdicts.size();
  for (const CheckRun& run : runs) {  // one that was merged while some were missing still says so
    if (of_any.of == 1 && run.head.shard.scenes > run.verdicts.size())
      all.head.shard.scenes += run.head.shard.scenes - run.verdicts.size();
  }
  std::vector<int> lacking;
  for (int i = 1; i <= of_any.of; ++i) {
    if (!there.contains(i)) lacking.push_back(i);
  }
  if (!lacking.empty()) {
    out.missing.push_back(fmt::format("missing: shard {} of {}", fmt::join(lacking, ", "), of_any.of));
  }
  if (all.verdicts.size() < all.head.shard.scenes) {
    out.missing.push_back(
        fmt::format("missing: {} of {} scenes", all.head.shard.scenes - all.verdicts.size(), all.head.shard.scenes));
  }
  return out;
}

}  // namespace plumbline::report

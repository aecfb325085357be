// plumb report: runs of plumb check by the JSON that they left.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_path.h"
#include "check/verdict/expectations.h"
#include "check/verdict/verdict.h"
#include "cli/commands.h"
#include "cli/options/outputs.h"
#include "cli/options/references.h"
#include "report/runs/json_report.h"
#include "report/runs/junit.h"
#include "report/runs/run_diff.h"
#include "report/runs/run_file.h"
#include "report/runs/run_merge.h"
#include "report/text/markdown.h"
#include "report/text/table.h"
#include "scene/file/scene_file.h"

namespace plumbline::cli {

int report_diff(const DiffOptions& o) {
  const std::vector<std::filesystem::path> inputs = {o.before, o.now};
  const Output outputs[] = {{"--json", o.json}, {"--markdown", o.markdown}};
  require_outputs(outputs, {}, inputs);
  report::DiffLimits limits;
  limits.factor = o.factor;
  limits.slower = o.slower;
  const report::RunDiff diff = report::diff(report::read_run(o.before), report::read_run(o.now), limits);
  fmt::print("{}", report::diff_text(diff));
  if (!o.json.empty()) write_file(o.json, report::diff_json(diff));
  if (!o.markdown.empty()) write_file(o.markdown, report::diff_markdown(diff));
  return report::holds(diff) ? kHolds : kDiffers;
}

namespace {

std::string name_of_scene(const std::filesystem::path& file) {
  return (file.parent_path().filename() / file.stem()).generic_string();
}

// The suite's scenes that are in no run, but those that are not meant to.
std::vector<std::string> lacking_of(std::span<const std::filesystem::path> suite,
                                    const std::vector<std::string>& without, const report::CheckRun& run) {
  std::set<std::filesystem::path> there;
  for (const check::SceneVerdict& verdict : run.verdicts) there.insert(std::filesystem::weakly_canonical(verdict.path));
  std::vector<std::string> out;
  for (const std::filesystem::path& file : suite) {
    if (std::ranges::count(without, name_of_scene(file)) > 0) continue;
    if (!there.contains(std::filesystem::weakly_canonical(file))) out.push_back("missing: " + file.string());
  }
  return out;
}

void require_scenes_of(std::span<const std::filesystem::path> suite, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::ranges::none_of(suite, [&](const auto& file) { return name_of_scene(file) == name; })) {
      throw std::runtime_error(fmt::format("--without {}: expected the name of a scene of --suite, group/scene", name));
    }
  }
}

}  // namespace

int report_merge(const MergeOptions& o) {
  std::vector<std::filesystem::path> inputs(o.runs.begin(), o.runs.end());
  std::vector<check::Expectation> expectations;
  if (!o.expect.empty()) {
    expectations = check::read_expectations(o.expect, names_of_rows());
    inputs.emplace_back(o.expect);
  }
  std::vector<std::filesystem::path> suite;
  if (!o.suite.empty()) {
    const std::filesystem::path folder[] = {o.suite};
    suite = find_scenes(folder);
    inputs.insert(inputs.end(), suite.begin(), suite.end());
  }
  require_scenes_of(suite, o.without);
  const Output outputs[] = {
      {"--output", o.output}, {"--junit", o.junit}, {"--markdown", o.markdown}, {"--ledger", o.ledger}};
  require_outputs(outputs, {}, inputs);
  std::vector<report::CheckRun> runs;
  for (const std::string& file : o.runs) runs.push_back(report::read_run(file));
  report::Merged merged = report::merge(std::move(runs));
  report::CheckRun& run = merged.run;
  std::vector<std::string> missing = std::move(merged.missing);
  const std::vector<std::string> lacking = lacking_of(suite, o.without, run);
  run.head.shard.scenes = std::max(run.head.shard.scenes, run.verdicts.size() + lacking.size());
  missing.insert(missing.end(), lacking.begin(), lacking.end());
  std::erase_if(expectations, [&](const auto& e) { return std::ranges::count(o.without, e.scene) > 0; });
  std::vector<std::string> failures = run.head.failures;
  if (missing.empty()) {
    for (std::string& line : check::of_no_scene(expectations, run.verdicts)) {
      if (std::ranges::count(failures, line) == 0) failures.push_back(std::move(line));
    }
    run.head.failures = failures;
  }
  failures.insert(failures.end(), missing.begin(), missing.end());
  const bool holds = report::all_hold(run.verdicts) && failures.empty();
  std::string lines, of_run;
  for (const check::SceneVerdict& verdict : run.verdicts) lines += verdict.failure;
  for (const std::string& line : failures) of_run += line + "\n";
  std::string summary;
  if (!o.without.empty()) summary = fmt::format("not run: {}\n", fmt::join(o.without, ", "));
  summary += report::summary(run.verdicts, holds, report::seconds(run.verdicts));
  fmt::print("{}{}{}{}", lines, of_run, report::group_lines(run.verdicts), summary);
  if (!o.output.empty()) report::write_json(o.output, run.verdicts, run.head);
  if (!o.junit.empty()) write_file(o.junit, report::junit(run.verdicts, failures));
  if (!o.markdown.empty()) write_file(o.markdown, report::markdown(run.verdicts, of_run + summary));
  if (!o.ledger.empty()) report::write_ledger(o.ledger, run.verdicts);
  if (holds && !run.verdicts.empty() && !check::any_judged(run.verdicts))
    throw std::invalid_argument("expected a run in which a scene was judged, found none");
  return holds ? kHolds : kDiffers;
}

}  // namespace plumbline::cli

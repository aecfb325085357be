// plumb report: runs of plumb check by the JSON that they left.
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "check/expectations.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/references.h"
#include "report/json_report.h"
#include "report/junit.h"
#include "report/markdown.h"
#include "report/run_diff.h"
#include "report/run_file.h"
#include "report/run_merge.h"
#include "report/table.h"
#include "scene/scene_file.h"
#include "stages/atomic_path.h"

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

// The suite's scenes that are in no run, but those that are not meant to.
std::vector<std::string> lacking_of(const std::string& suite, const std::vector<std::string>& without,
                                    const report::CheckRun& run) {
  std::set<std::filesystem::path> there;
  for (const check::SceneVerdict& verdict : run.verdicts) there.insert(std::filesystem::weakly_canonical(verdict.path));
  std::vector<std::string> out;
  const std::vector<std::filesystem::path> folder = {suite};
  for (const std::filesystem::path& file : find_scenes(folder)) {
    const std::string name = (file.parent_path().filename() / file.stem()).string();
    if (std::ranges::count(without, name) == 0 && !there.contains(std::filesystem::weakly_canonical(file))) {
      out.push_back("missing: " + file.string());
    }
  }
  return out;
}

}  // namespace

int report_merge(const MergeOptions& o) {
  std::vector<std::filesystem::path> inputs(o.runs.begin(), o.runs.end());
  std::vector<check::Expectation> expectations;
  if (!o.expect.empty()) {
    expectations = check::read_expectations(o.expect, names_of_rows());
    inputs.emplace_back(o.expect);
  }
  const Output outputs[] = {
      {"--output", o.output}, {"--junit", o.junit}, {"--markdown", o.markdown}, {"--ledger", o.ledger}};
  require_outputs(outputs, {}, inputs);
  std::vector<report::CheckRun> runs;
  for (const std::string& file : o.runs) runs.push_back(report::read_run(file));
  report::Merged merged = report::merge(std::move(runs));
  report::CheckRun& run = merged.run;
  std::vector<std::string> missing = std::move(merged.missing);
  if (!o.suite.empty()) std::ranges::move(lacking_of(o.suite, o.without, run), std::back_inserter(missing));
  if (missing.empty()) {
    std::ranges::move(check::of_no_scene(expectations, run.verdicts), std::back_inserter(run.head.failures));
  }
  std::vector<std::string> failures = run.head.failures;
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
  return holds ? kHolds : kDiffers;
}

}  // namespace plumbline::cli

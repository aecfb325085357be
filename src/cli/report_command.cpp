// plumb report: runs of plumb check by the JSON that they left.
#include <filesystem>

#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/outputs.h"
#include "report/json_report.h"
#include "report/junit.h"
#include "report/markdown.h"
#include "report/run_diff.h"
#include "report/run_file.h"
#include "report/run_merge.h"
#include "report/table.h"
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

int report_merge(const MergeOptions& o) {
  const std::vector<std::filesystem::path> inputs(o.runs.begin(), o.runs.end());
  const Output outputs[] = {
      {"--output", o.output}, {"--junit", o.junit}, {"--markdown", o.markdown}, {"--ledger", o.ledger}};
  require_outputs(outputs, {}, inputs);
  std::vector<report::CheckRun> runs;
  for (const std::string& file : o.runs) runs.push_back(report::read_run(file));
  const report::Merged merged = report::merge(std::move(runs));
  const report::CheckRun& run = merged.run;
  const bool holds = report::all_hold(run.verdicts) && merged.missing.empty();
  std::string lines, lacking;
  for (const check::SceneVerdict& verdict : run.verdicts) lines += verdict.failure;
  for (const std::string& line : merged.missing) lacking += line + "\n";
  const std::string summary = report::summary(run.verdicts, holds, report::seconds(run.verdicts));
  fmt::print("{}{}{}{}", lines, lacking, report::group_lines(run.verdicts), summary);
  if (!o.output.empty()) report::write_json(o.output, run.verdicts, run.versions, run.shard);
  if (!o.junit.empty()) write_file(o.junit, report::junit(run.verdicts, merged.missing));
  if (!o.markdown.empty()) write_file(o.markdown, report::markdown(run.verdicts, lacking + summary));
  if (!o.ledger.empty()) report::write_ledger(o.ledger, run.verdicts);
  return holds ? kHolds : kDiffers;
}

}  // namespace plumbline::cli

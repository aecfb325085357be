#include "cli/submissions.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_path.h"
#include "base/utf8.h"
#include "check/verdict/verdict.h"
#include "cli/judge_in_workers.h"
#include "cli/options/outputs.h"
#include "cli/options/program_argument.h"
#include "report/runs/run_file.h"
#include "report/text/conformance.h"
#include "report/text/markdown.h"
#include "report/text/table.h"

namespace plumbline::cli {

namespace {

namespace fs = std::filesystem;

std::vector<fs::path> folders_in(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> out;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const bool hidden = entry.path().filename().string().starts_with('.');
    if (entry.is_directory() && !hidden) out.push_back(entry.path());
  }
  if (error) throw std::invalid_argument(fmt::format("--submissions: {}: {}", folder, error.message()));
  if (out.empty()) {
    throw std::invalid_argument(fmt::format("--submissions: {}: expected a folder for each, found none", folder));
  }
  std::ranges::sort(out);
  return out;
}

struct Row {
  std::string name, points;
  report::FeatureTally tally;
};

std::string most_frequent(const report::FeatureTally& tally) {
  if (tally.first_wrong.empty()) return "";
  return fmt::format("{} {}", tally.first_wrong.front().first, tally.first_wrong.front().second);
}

std::string line(const Row& row) {
  const report::FeatureTally& t = row.tally;
  return fmt::format("{:<24} {:>10} {:>6} {:>6} {:>6} {:>6} {:>6}  {}\n", row.name, row.points, t.holds, t.legal,
                     t.differs, t.failed, t.unable, most_frequent(t));
}

std::string markdown_of(const std::vector<Row>& rows) {
  std::string out =
      "## Submissions\n\n| submission | points | right | legal | wrong | failed | unable | most frequent first wrong "
      "stage |\n|---|---|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const report::FeatureTally& t = row.tally;
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} |\n", report::cell(row.name), row.points, t.holds,
                       t.legal, t.differs, t.failed, t.unable, report::cell(most_frequent(t)));
  }
  return out;
}

std::string points_of(const report::Rubric& rubric, std::span<const check::SceneVerdict> verdicts) {
  double earned = 0, points = 0;
  for (const report::SceneRubric& scene : rubric.scenes) {
    const report::SceneGrade g =
        report::grade(scene, *std::ranges::find(verdicts, scene.scene, &check::SceneVerdict::scene));
    earned += g.earned, points += g.points;
  }
  return fmt::format("{} of {}", earned, points);
}

}  // namespace

int check_submissions(const CheckRules& given, std::span<const Scene> scenes,
                      const std::optional<report::Rubric>& rubric) {
  const CheckOptions& o = given.options;
  const std::vector<fs::path> folders = folders_in(o.submissions);
  for (const fs::path& folder : folders) {  // refuses what is no command line
    ProgramArgument of_folder = o.candidate;
    of_folder.command = command_of_submission(o.candidate.command, folder);
    make_program(of_folder);
  }
  const Output outputs[] = {{"--markdown", o.markdown}};
  require_outputs(outputs, {"--report", ""}, {});
  if (rubric) std::filesystem::create_directories(o.grades);
  if (rubric) require_folder({"--grades", o.grades});
  std::vector<Row> rows;
  bool all_hold = true;
  fmt::print("{:<24} {:>10} {:>6} {:>6} {:>6} {:>6} {:>6}  {}\n", "submission", "points", "right", "legal", "wrong",
             "failed", "unable", "first wrong stage");
  for (const fs::path& folder : folders) {
    CheckRules rules{o, given.today, given.expectations};
    rules.options.candidate.command = command_of_submission(o.candidate.command, folder);
    std::set<std::string> words;
    std::vector<check::SceneVerdict> verdicts;
    judge_in_workers(scenes, rules, words, [&](JudgedScene judged) { verdicts.push_back(std::move(judged.verdict)); });
    rows.push_back({as_utf8(folder.filename().string()), rubric ? points_of(*rubric, verdicts) : "-",
                    report::whole_suite(verdicts)});
    all_hold &= report::all_hold(verdicts) && check::any_judged(verdicts);
    fmt::print("{}", line(rows.back()));
    std::fflush(stdout);
    if (!rubric) continue;
    write_file(fs::path(o.grades) / (folder.filename().string() + ".json"), report::gradescope_json(*rubric, verdicts));
  }
  if (!o.markdown.empty()) write_file(o.markdown, markdown_of(rows));
  return all_hold ? kHolds : kDiffers;
}

}  // namespace plumbline::cli

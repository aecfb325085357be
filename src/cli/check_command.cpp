// plumb check: scenes against references, stage by stage.
#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_path.h"
#include "base/confine.h"
#include "check/golden/golden_set.h"
#include "check/verdict/expectations.h"
#include "cli/check_failures.h"
#include "cli/commands.h"
#include "cli/fingerprints.h"
#include "cli/judge_in_workers.h"
#include "cli/options/default_cache.h"
#include "cli/options/outputs.h"
#include "cli/options/program_argument.h"
#include "cli/options/references.h"
#include "cli/options/renderers.h"
#include "cli/options/shard_argument.h"
#include "cli/scene_judge.h"
#include "cli/submissions.h"
#include "report/page/html_report.h"
#include "report/runs/grade.h"
#include "report/runs/json_report.h"
#include "report/runs/junit.h"
#include "report/runs/run_file.h"
#include "report/text/conformance.h"
#include "report/text/markdown.h"
#include "report/text/table.h"
#include "scene/file/scene_file.h"

namespace plumbline::cli {

namespace {

std::chrono::sys_days today(const CheckOptions& o) {
  if (!o.today.empty()) return check::day_of(o.today);
  return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
}

// Whether a whole suite is judged, a folder of several groups and no shard of it: then each expectation must be of a
// scene that was judged.
bool is_whole(const CheckOptions& o, std::span<const check::SceneVerdict> verdicts) {
  std::set<std::string> groups;
  for (const check::SceneVerdict& v : verdicts) groups.insert(check::group_of(v.scene));
  return o.shard.empty() && groups.size() > 1 &&
         std::ranges::any_of(o.scenes, [](const std::string& path) { return std::filesystem::is_directory(path); });
}

// Checks the folders of --rows and --failures, in which each scene leaves files of its name: no two scenes have one
// name.
void require_folders(const CheckOptions& o, std::span<const Scene> scenes) {
  require_folder({"--rows", o.rows});
  require_folder({"--failures", o.failures});
  for (const Output& folder : {Output{"--rows", o.rows}, Output{"--failures", o.failures}}) {
    require_outside(folder, {"--report", o.report});
  }
  if (o.rows.empty() && o.failures.empty()) return;
  std::map<std::string, const Scene*> by_name;
  for (const Scene& scene : scenes) {
    const auto [at, is_new] = by_name.try_emplace(scene.name, &scene);
    if (is_new) continue;
    throw SceneError(fmt::format("{}: expected scenes of different names (--rows, --failures), found {} in {} as well",
                                 scene.path, scene.name, at->second->path));
  }
}

// Throws where a scene of the rubric is not among the scenes that are run.
void require_scenes(const report::Rubric& rubric, std::span<const Scene> scenes, const std::string& file) {
  for (const report::SceneRubric& of : rubric.scenes) {
    if (std::ranges::find(scenes, of.scene, &Scene::name) != scenes.end()) continue;
    throw std::invalid_argument(
        fmt::format("{}: at \"/scenes\": expected scenes that are run, found {}", file, of.scene));
  }
}

constexpr std::uint64_t kMostKept = std::uint64_t{64} << 20;  // [bytes] of verdicts for later runs

std::string lines_of(std::span<const std::string> lines) {
  return lines.empty() ? "" : fmt::format("{}\n", fmt::join(lines, "\n"));
}

// Line of the default references that --against leaves out or this build lacks; empty: none.
std::string not_asked_line(const CheckOptions& o) {
  std::vector<std::string> names = reference_names();
  std::erase_if(names, [&](const std::string& name) { return std::ranges::count(o.against, name) > 0; });
  for (std::string& name : names) {
    if (std::ranges::count(default_references(), name) == 0) name += " (not built in)";
  }
  return names.empty() ? "" : fmt::format("not asked: {}\n", fmt::join(names, ", "));
}

// All files that the run reads, but images and meshes.
std::vector<std::filesystem::path> inputs_of(const CheckOptions& o, std::span<const Scene> scenes) {
  std::vector<std::filesystem::path> out;
  for (const Scene& scene : scenes) out.insert(out.end(), scene.files.begin(), scene.files.end());
  if (!o.expect.empty()) out.emplace_back(o.expect);
  if (!o.rubric.empty()) out.emplace_back(o.rubric);
  if (o.golden.empty() || !std::filesystem::is_directory(o.golden)) return out;
  try {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(o.golden)) out.push_back(entry.path());
  } catch (const std::filesystem::filesystem_error& e) {  // of a folder within it names none
    throw std::runtime_error(fmt::format("{}: cannot be read: {}", o.golden, e.code().message()));
  }
  return out;
}

// Whether other conventions may explain what is wrong: none are declared, and a scene differs, or more scenes are wrong
// than right.
bool may_be_conventions(const CheckOptions& o, std::span<const check::SceneVerdict> verdicts) {
  if (o.candidate.conventions.empty()) return std::ranges::any_of(verdicts, check::first_different);
  const report::FeatureTally all = report::whole_suite(verdicts);
  return all.differs > all.holds;
}

// Outcome of a run: its head, and what each scene came to.
struct JudgedRun {
  report::RunHead head;
  std::vector<check::SceneVerdict> verdicts;
  std::vector<check::Settled> settled;
  RunFailures failures;         // the diagnoses of scenes that do not hold
  std::set<std::string> words;  // that verdicts refer to
};

// Judges the scenes, and prints a line for each one that holds, and the rows of the others.
void judge_all(const std::vector<Scene>& scenes, CheckRules& rules, JudgedRun& run) {
  const CheckOptions& o = rules.options;
  const bool all_rows = o.verbose || scenes.size() == 1;
  bool has_head = false;
  const auto print = [&](const check::SceneVerdict& verdict) {
    const bool is_line = !all_rows && verdict.failure.empty();
    if (!is_line && !has_head) fmt::print("{}", report::table_head());
    has_head |= !is_line;
    fmt::print("{}", is_line ? report::scene_line(verdict) : report::table_rows(verdict));
    std::fflush(stdout);
  };
  const auto take = [&](JudgedScene judged) {
    const check::SceneVerdict& verdict = run.verdicts.emplace_back(std::move(judged.verdict));
    std::ranges::move(judged.settled, std::back_inserter(run.settled));
    print(verdict);
    if (!o.rows.empty()) leave_rows(o.rows, verdict, judged.failure);
    run.failures.add(verdict, std::move(judged.failure));
    if (judged.drawing) rules.page->add(std::move(*judged.drawing));
    run.head.versions.merge(judged.versions);
  };
  judge_in_workers(scenes, rules, run.words, take);
  if (rules.kept) rules.kept->store.trim(kMostKept);
}

std::string summary_of(const CheckRules& rules, const JudgedRun& run, bool holds, double seconds) {
  const CheckOptions& o = rules.options;
  std::string out = not_asked_line(o);
  if (!o.candidate.command.empty()) {
    out += convention_notes(o.candidate.conventions);
    if (may_be_conventions(o, run.verdicts)) out += hint_of_conventions(o.candidate.conventions);
    if (!can_confine()) out += "this kernel cannot confine where the program writes\n";
  }
  if (!o.expect.empty()) out += settled_line(run.settled, rules.expectations.size());
  out += report::summary(run.verdicts, holds, seconds);
  if (!holds && report::all_hold(run.verdicts)) {
    out += fmt::format("{}: FAILED by conventions or expectations alone\n",
                       check::any_judged(run.verdicts) ? "the scenes hold" : "no scene could be judged");
  }
  return out;
}

// Writes the files that the options ask for.
void write_outputs(CheckRules& rules, const JudgedRun& run, const std::optional<report::Rubric>& rubric,
                   const std::string& summary) {
  const CheckOptions& o = rules.options;
  const bool outside = !o.candidate.command.empty();
  if (!o.json.empty()) report::write_json(o.json, run.verdicts, run.head);
  if (!o.ledger.empty()) report::write_ledger(o.ledger, run.verdicts);
  if (!o.junit.empty()) write_file(o.junit, report::junit(run.verdicts, run.head.failures));
  if (!o.markdown.empty()) {
    write_file(o.markdown, report::markdown(run.verdicts, lines_of(run.head.failures) + summary) +
                               (outside ? report::conformance_markdown(run.verdicts) : "") +
                               (rubric ? report::grades_markdown(*rubric, run.verdicts) : ""));
  }
  if (rubric) write_file(o.grades, report::gradescope_json(*rubric, run.verdicts));
  if (rules.page) rules.page->write(outside ? report::conformance_text(run.verdicts) + summary : summary);
}

}  // namespace

int check(const CheckOptions& given) {
  CheckOptions o = given;
  o.against = without_repeats(given.against);
  if (const std::string faulted = faulted_reference(o.fault);
      !faulted.empty() && std::ranges::count(o.against, faulted) == 0)
    throw std::invalid_argument(fmt::format("--fault: {} is not among the references asked", faulted));
  require_references(o.against);
  const auto start = std::chrono::steady_clock::now();
  const auto began = std::filesystem::file_time_type::clock::now();
  if (!o.candidate.command.empty() && o.submissions.empty()) require_program(o.candidate);
  const std::vector<std::filesystem::path> paths(o.scenes.begin(), o.scenes.end());
  std::vector<std::filesystem::path> files = find_scenes(paths);
  const report::Shard shard = take_shard(files, o.shard);
  CheckRules rules{o, today(o)};
  if (faulted_reference(o.fault).empty()) make_candidate(o.fault);  // refuses a name that none has
  std::optional<report::Rubric> rubric;
  if (!o.rubric.empty()) rubric = report::read_rubric(o.rubric);
  if (!o.expect.empty()) rules.expectations = check::read_expectations(o.expect, names_of_rows());
  // All of them first: a bad one ends the run before anything is written.
  const std::vector<Scene> scenes = o.scene_arguments.load(
      files, [](const Scene& scene) { require_budget(scene, plane_bytes(scene), Request{}.memory_budget); });
  if (rubric) require_scenes(*rubric, scenes, o.rubric);
  if (!o.submissions.empty()) return check_submissions(rules, scenes, rubric);
  const Output outputs[] = {{"--json", o.json},
                            {"--ledger", o.ledger},
                            {"--junit", o.junit},
                            {"--markdown", o.markdown},
                            {"--grades", o.grades}};
  require_outputs(outputs, {"--report", o.report}, inputs_of(o, scenes));
  require_folders(o, scenes);
  JudgedRun run{{{}, o.fault, o.against, !o.golden.empty(), shard, {}}, {}, {}, {}, {}};
  if (!o.golden.empty()) rules.goldens.emplace(o.golden, check::GoldenSet::Access::read);
  if (!o.report.empty()) rules.page.emplace(o.report, scenes.size());
  // A page shows what both sides drew, and a reference with a fault is none of this program's judges.
  const std::string cache = rules.page || !faulted_reference(o.fault).empty() ? "" : made_cache(o.cache);
  if (!cache.empty()) rules.kept = {check::VerdictStore(cache), judges_fingerprint(o), check::tried_at_random, began};
  judge_all(scenes, rules, run);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (is_whole(o, run.verdicts)) run.head.failures = check::of_no_scene(rules.expectations, run.verdicts);
  for (const std::string& line : not_accepted(conventions_of(o.candidate.conventions)))
    run.head.failures.push_back(line);
  const bool holds = report::all_hold(run.verdicts) && run.head.failures.empty();
  const bool outside = !o.candidate.command.empty();
  const std::string summary = summary_of(rules, run, holds, seconds);
  fmt::print("\n{}{}{}{}", run.failures.text(), lines_of(run.head.failures),
             outside ? report::conformance_text(run.verdicts) : report::group_lines(run.verdicts), summary);
  write_outputs(rules, run, rubric, summary);
  if (holds && !run.verdicts.empty() && !check::any_judged(run.verdicts)) {
    throw std::invalid_argument(outside ? "--program: expected a scene that it draws and that can be judged, found none"
                                        : "expected a scene that a reference can judge, found none");
  }
  return holds ? kHolds : kDiffers;
}

}  // namespace plumbline::cli

// plumb check: scenes against references, stage by stage.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "check/expectations.h"
#include "check/golden.h"
#include "check/judge.h"
#include "cli/check_failures.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/references.h"
#include "cli/shard_argument.h"
#include "report/html_report.h"
#include "report/json_report.h"
#include "report/junit.h"
#include "report/markdown.h"
#include "report/run_file.h"
#include "report/table.h"
#include "scene/scene_file.h"
#include "stages/atomic_path.h"

namespace plumbline::cli {

namespace {

std::chrono::sys_days today(const CheckOptions& o) {
  if (!o.today.empty()) return check::day_of(o.today);
  return std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now());
}

// The whole suite was asked: a folder of several groups, no shard of it. Then each expectation must be of a scene in
// it.
bool is_whole(const CheckOptions& o, std::span<const check::SceneVerdict> verdicts) {
  std::set<std::string> groups;
  for (const check::SceneVerdict& v : verdicts) groups.insert(v.scene.substr(0, v.scene.find('/')));
  return o.shard.empty() && groups.size() > 1 &&
         std::ranges::any_of(o.scenes, [](const std::string& path) { return std::filesystem::is_directory(path); });
}

// Each scene leaves files of its name there.
void require_folders(const CheckOptions& o, std::span<const Scene> scenes) {
  require_folder({"--rows", o.rows});
  require_folder({"--failures", o.failures});
  if (o.rows.empty() && o.failures.empty()) return;
  std::map<std::string, const Scene*> by_name;
  for (const Scene& scene : scenes) {
    const auto [at, is_new] = by_name.try_emplace(scene.name, &scene);
    if (is_new) continue;
    throw SceneError(fmt::format("{}: expected scenes of different names (--rows, --failures), found {} in {} as well",
                                 scene.path, scene.name, at->second->path));
  }
}

std::string lines_of(std::span<const std::string> lines) {
  return lines.empty() ? "" : fmt::format("{}\n", fmt::join(lines, "\n"));
}

// What the table does not hold because nobody asked, if any.
std::string not_asked_line(const CheckOptions& o) {
  std::vector<std::string> names = reference_names();
  std::erase_if(names, [&](const std::string& name) { return std::ranges::count(o.against, name) > 0; });
  return names.empty() ? "" : fmt::format("not asked: {}\n", fmt::join(names, ", "));
}

// All files that the run reads, but images and meshes.
std::vector<std::filesystem::path> inputs_of(const CheckOptions& o, std::span<const Scene> scenes) {
  std::vector<std::filesystem::path> out;
  for (const Scene& scene : scenes) out.insert(out.end(), scene.files.begin(), scene.files.end());
  if (!o.expect.empty()) out.emplace_back(o.expect);
  if (o.golden.empty() || !std::filesystem::is_directory(o.golden)) return out;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(o.golden)) out.push_back(entry.path());
  return out;
}

}  // namespace

int check(const CheckOptions& given) {
  CheckOptions o = given;
  o.against = without_repeats(given.against);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::filesystem::path> paths(o.scenes.begin(), o.scenes.end());
  std::vector<std::filesystem::path> files = find_scenes(paths);
  const report::Shard shard = take_shard(files, o.shard);
  const std::chrono::sys_days day = today(o);
  std::vector<check::Expectation> expectations;
  if (!o.expect.empty()) expectations = check::read_expectations(o.expect, names_of_rows());
  std::vector<Scene> scenes;  // all of them first: a bad one ends the run before anything is written
  for (const auto& file : files) {
    scenes.push_back(o.scene_arguments.load(file));
    require_budget(scenes.back(), plane_bytes(scenes.back()), Request{}.memory_budget);
  }
  const Output outputs[] = {
      {"--json", o.json}, {"--ledger", o.ledger}, {"--junit", o.junit}, {"--markdown", o.markdown}};
  require_outputs(outputs, {"--report", o.report}, inputs_of(o, scenes));
  require_folders(o, scenes);
  const std::unique_ptr<Renderer> candidate = make_candidate(o.fault);
  const References references = make_references(o.against, o.scene_arguments.assets);
  report::RunHead head{versions_of(*candidate, references), o.fault, o.against, !o.golden.empty(), shard, {}};
  std::optional<check::GoldenSet> goldens;
  if (!o.golden.empty()) goldens.emplace(o.golden, check::GoldenSet::Access::read);
  std::optional<report::HtmlReport> page;
  if (!o.report.empty()) page.emplace(o.report, scenes.size());
  const bool terminal = isatty(STDERR_FILENO) != 0;
  std::vector<check::SceneVerdict> verdicts;
  std::vector<check::Settled> settled;
  std::string failures;
  fmt::print("{}", report::table_head());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    if (terminal) fmt::print(stderr, "\r\x1b[K[{}/{}] {}\r", i + 1, scenes.size(), scene.path);
    check::Drawn drawn;
    check::SceneVerdict& verdict =
        verdicts.emplace_back(check::judge(scene, *candidate, references.list, page ? &drawn : nullptr));
    if (goldens)
      std::ranges::move(check::golden_rows(scene, *candidate, *goldens), std::back_inserter(verdict.comparisons));
    std::ranges::move(settle(verdict, o, expectations, day), std::back_inserter(settled));
    fmt::print("{}", report::table_rows(verdict));
    std::fflush(stdout);
    std::string failure = verdict.failure;
    if (!failure.empty() && !o.failures.empty()) {
      failure += leave_report(o.failures, scene, verdict, *candidate, references.list);
    }
    if (!o.rows.empty()) leave_rows(o.rows, verdict, failure);
    failures += failure;
    if (page) page->add(verdict, references.list, drawn, scene, verdict.failure, verdict.repeat);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (is_whole(o, verdicts)) head.failures = check::of_no_scene(expectations, verdicts);
  const bool holds = report::all_hold(verdicts) && head.failures.empty();
  std::string summary = not_asked_line(o);
  if (!o.expect.empty()) summary += settled_line(settled, expectations.size());
  summary += report::summary(verdicts, holds, seconds);
  const std::string of_run = lines_of(head.failures);
  fmt::print("\n{}{}{}{}", failures, of_run, report::group_lines(verdicts), summary);
  if (!o.json.empty()) report::write_json(o.json, verdicts, head);
  if (!o.ledger.empty()) report::write_ledger(o.ledger, verdicts);
  if (!o.junit.empty()) write_file(o.junit, report::junit(verdicts, head.failures));
  if (!o.markdown.empty()) write_file(o.markdown, report::markdown(verdicts, of_run + summary));
  if (page) page->write(summary);
  return holds ? kHolds : kDiffers;
}

}  // namespace plumbline::cli

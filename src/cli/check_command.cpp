// plumb check: scenes against references, stage by stage.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "check/golden.h"
#include "check/judge.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "cli/references.h"
#include "report/html_report.h"
#include "report/json_report.h"
#include "report/table.h"
#include "scene/scene_file.h"

namespace plumbline::cli {

namespace {

std::string repeat_command(const CheckOptions& o, const check::SceneVerdict& verdict) {
  std::string out = shell_word(o.program) + " check " + shell_word(verdict.path);
  if (o.against != reference_names()) out += fmt::format(" --against {}", fmt::join(o.against, ","));
  if (!o.golden.empty()) out += " --golden " + shell_word(o.golden);
  if (!o.fault.empty()) out += " --fault " + shell_word(o.fault);
  if (o.allow_missing) out += " --allow-missing";
  return out + o.scene_arguments.repeated();
}

// Whether the references are asked that are asked where none are named, others beside them or not.
bool all_asked(const CheckOptions& o) {
  return std::ranges::all_of(reference_names(),
                             [&](const std::string& name) { return std::ranges::count(o.against, name) > 0; });
}

// The stages whose lack of a judge is a failure: with all references asked, all but what --allow-missing forgives.
// Where a renderer failed, that is the failure.
std::vector<Stage> unjudged(const check::SceneVerdict& verdict, const CheckOptions& o) {
  const auto failed = [](const check::Comparison& c) { return c.outcome == check::Outcome::failed; };
  if (!all_asked(o) || std::ranges::any_of(verdict.comparisons, failed)) return {};
  std::vector<Stage> out = check::unjudged_stages(verdict);
  if (!o.allow_missing) return out;
  const std::vector<Stage> forgiven = check::stages_lost_to_missing(verdict);
  std::erase_if(out, [&](Stage stage) { return std::ranges::count(forgiven, stage) > 0; });
  return out;
}

bool holds(const check::SceneVerdict& verdict, const CheckOptions& o) {
  return unjudged(verdict, o).empty() && std::ranges::none_of(verdict.comparisons, [&](const check::Comparison& c) {
           return is_failure(c.outcome) && !(o.allow_missing && c.outcome == check::Outcome::missing);
         });
}

}  // namespace

int check(const CheckOptions& given) {
  CheckOptions o = given;
  o.against = without_repeats(given.against);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::filesystem::path> paths(o.scenes.begin(), o.scenes.end());
  const std::vector<std::filesystem::path> files = find_scenes(paths);
  std::vector<Scene> scenes;  // all of them first: a bad one ends the run before anything is written
  for (const auto& file : files) {
    scenes.push_back(o.scene_arguments.load(file));
    require_budget(scenes.back(), plane_bytes(scenes.back()), Request{}.memory_budget);
  }
  const Output outputs[] = {{"--json", o.json}, {"--ledger", o.ledger}};
  require_outputs(outputs, {"--report", o.report}, files);
  const std::unique_ptr<Renderer> candidate = make_candidate(o.fault);
  const References references = make_references(o.against, o.scene_arguments.assets);
  const std::map<std::string, std::string> versions = versions_of(*candidate, references);
  std::optional<check::GoldenSet> goldens;
  if (!o.golden.empty()) goldens.emplace(o.golden, check::GoldenSet::Access::read);
  std::optional<report::HtmlReport> page;
  if (!o.report.empty()) page.emplace(o.report, scenes.size());
  const bool terminal = isatty(STDERR_FILENO) != 0;
  std::vector<check::SceneVerdict> verdicts;
  std::string failures;
  bool all_hold = true;
  fmt::print("{}", report::table_head());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const Scene& scene = scenes[i];
    if (terminal) fmt::print(stderr, "\r\x1b[K[{}/{}] {}\r", i + 1, scenes.size(), scene.path);
    check::Drawn drawn;
    verdicts.push_back(check::judge(scene, *candidate, references.list, page ? &drawn : nullptr));
    if (goldens)
      std::ranges::move(check::golden_rows(scene, *candidate, *goldens),
                        std::back_inserter(verdicts.back().comparisons));
    fmt::print("{}", report::table_rows(verdicts.back()));
    std::fflush(stdout);
    const std::string repeat = repeat_command(o, verdicts.back());
    std::string failure;
    if (!holds(verdicts.back(), o)) {
      all_hold = false;
      failure = report::failure_lines(verdicts.back(), unjudged(verdicts.back(), o), repeat);
      failures += failure;
    }
    if (page) page->add(verdicts.back(), references.list, drawn, scene, failure, repeat);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string summary = report::summary(verdicts, all_hold, seconds);
  fmt::print("\n{}{}{}", failures, report::group_lines(verdicts), summary);
  if (!o.json.empty()) report::write_json(o.json, verdicts, versions);
  if (!o.ledger.empty()) report::write_ledger(o.ledger, verdicts);
  if (page) page->write(summary);
  return all_hold ? kHolds : kDiffers;
}

}  // namespace plumbline::cli

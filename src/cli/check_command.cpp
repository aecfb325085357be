// plumb check: scenes against references, stage by stage.
#include <unistd.h>

#include <chrono>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "check/judge.h"
#include "cli/commands.h"
#include "cli/renderers.h"
#include "cli/scene_arguments.h"
#include "report/html_report.h"
#include "report/json_report.h"
#include "report/table.h"
#include "scene/scene_file.h"

namespace plumbline::cli {

namespace {

struct CheckArguments {
  std::vector<std::string> scenes, against = reference_names();
  std::string json, report, ledger, fault;
  bool allow_missing = false;
  SceneArguments scene_arguments;
};

struct References {
  std::vector<std::unique_ptr<Renderer>> owned;
  std::vector<check::Reference> list;
};

References make_references(const std::vector<std::string>& names) {
  References out;
  for (const std::string& name : names) {
    out.owned.push_back(make_renderer(name));
    out.list.push_back({name, out.owned.back().get()});
  }
  return out;
}

std::string repeat_command(const CheckArguments& a, const check::SceneVerdict& verdict) {
  std::string out = "plumb check " + shell_word(verdict.path);
  if (a.against != reference_names()) out += fmt::format(" --against {}", fmt::join(a.against, ","));
  if (!a.fault.empty()) out += " --fault " + shell_word(a.fault);
  return out + a.scene_arguments.repeated();
}

// With all references asked, a stage that none of them judged is a failure as well.
bool holds(const check::SceneVerdict& verdict, const CheckArguments& a) {
  for (const check::Comparison& c : verdict.comparisons) {
    if (is_failure(c.outcome) && !(a.allow_missing && c.outcome == check::Outcome::missing)) return false;
  }
  return a.against != reference_names() || a.allow_missing || check::unjudged_stages(verdict).empty();
}

int run(const CheckArguments& a) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::filesystem::path> paths(a.scenes.begin(), a.scenes.end());
  std::vector<Scene> scenes;  // all of them first: a bad one ends the run before anything is written
  for (const auto& file : find_scenes(paths)) scenes.push_back(a.scene_arguments.load(file));
  const std::unique_ptr<Renderer> candidate = make_candidate(a.fault);
  const References references = make_references(a.against);
  std::map<std::string, std::string> versions{{candidate->info().name, candidate->info().version}};
  for (const check::Reference& r : references.list) {
    if (r.renderer != nullptr) versions[r.name] = r.renderer->info().version;
  }
  std::optional<report::HtmlReport> page;
  if (!a.report.empty()) page.emplace(a.report);
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
    fmt::print("{}", report::table_rows(verdicts.back()));
    std::fflush(stdout);
    if (!holds(verdicts.back(), a)) {
      all_hold = false;
      failures += report::failure_lines(verdicts.back(), repeat_command(a, verdicts.back()));
    }
    if (page) page->add(verdicts.back(), references.list, drawn, scene.description);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string summary = report::summary(verdicts, seconds);
  fmt::print("\n{}{}", failures, summary);
  if (!a.json.empty()) report::write_json(a.json, verdicts, versions);
  if (!a.ledger.empty()) report::write_ledger(a.ledger, verdicts);
  if (page) page->write(summary);
  return all_hold ? kHolds : kDiffers;
}

}  // namespace

Command add_check(CLI::App& app) {
  auto a = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check", "Compare our renderer with the references, stage by stage");
  command->add_option("scenes", a->scenes, "Scene files, and folders of them")->required();
  command->add_option("--against", a->against, "References: osmesa, embree, exact (default: all three)")
      ->check(CLI::IsMember(reference_names()))
      ->delimiter(',');
  command->add_option("--json", a->json, "Write one object per comparison");
  command->add_option("--report", a->report, "Write a page with pictures into this folder");
  command->add_option("--ledger", a->ledger, "Write the largest difference seen for each tolerance");
  command->add_option("--fault", a->fault, "Put a bug into our renderer (plumb list faults)");
  command->add_flag("--allow-missing", a->allow_missing, "A reference that is not built in is no failure");
  a->scene_arguments.add_to(*command);
  return [a, command] { return command->parsed() ? run(*a) : -1; };
}

}  // namespace plumbline::cli

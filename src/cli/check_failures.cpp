#include "cli/check_failures.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/atomic_path.h"
#include "capture/files/image_file.h"
#include "cli/options/references.h"
#include "report/page/html_report.h"
#include "report/page/page.h"
#include "report/text/safe_text.h"
#include "report/text/table.h"

namespace plumbline::cli {

namespace {

std::string repeat_command(const CheckOptions& o, const check::SceneVerdict& verdict) {
  const bool as_option = verdict.path.starts_with('-');
  std::string out = shell_word(o.program) + " check " + shell_word((as_option ? "./" : "") + verdict.path);
  if (o.against != default_references()) out += fmt::format(" --against {}", fmt::join(o.against, ","));
  if (!o.golden.empty()) out += " --golden " + shell_word(o.golden);
  if (!o.fault.empty()) out += " --fault " + shell_word(o.fault);
  if (!o.candidate.command.empty()) out += " --program " + shell_word(o.candidate.command);
  if (o.candidate.probes) out += " --each-primitive";
  if (!o.candidate.from.empty()) out += " --from " + o.candidate.from;
  if (!o.candidate.conventions.empty()) out += " --conventions " + shell_word(o.candidate.conventions);
  if (!o.expect.empty()) out += " --expect " + shell_word(o.expect);
  if (!o.today.empty()) out += " --today " + o.today;
  if (o.allow_missing) out += " --allow-missing";
  const WorkerLimits usual;
  if (o.limits.step != usual.step || o.candidate.time_limit != ProgramArgument().time_limit)
    out += fmt::format(" --time-limit {}", o.limits.step / std::chrono::seconds(1));
  if (o.limits.memory != usual.memory) out += fmt::format(" --memory-limit {}", o.limits.memory >> 20);
  return out + o.scene_arguments.repeated();
}

// Whether the references of a whole judgement are asked, others beside them or not.
bool all_asked(const CheckOptions& o) {
  return std::ranges::all_of(reference_names(),
                             [&](const std::string& name) { return std::ranges::count(o.against, name) > 0; });
}

// The stages whose lack of a judge is a failure: with all references asked, all but what --allow-missing forgives.
// Where a renderer failed, that is the failure.
std::vector<Stage> unjudged(const check::SceneVerdict& verdict, const CheckOptions& o) {
  const auto failed = [](const check::Comparison& c) { return c.outcome == check::Outcome::failed; };
  if (!all_asked(o) || std::ranges::any_of(verdict.comparisons, failed)) return {};
  if (!o.candidate.command.empty())
    return {};  // a program need not show all stages: conformance() says what was judged
  std::vector<Stage> out = check::unjudged_stages(verdict);
  if (!o.allow_missing) return out;
  const std::vector<Stage> forgiven = check::stages_lost_to_missing(verdict);
  std::erase_if(out, [&](Stage stage) { return std::ranges::count(forgiven, stage) > 0; });
  return out;
}

}  // namespace

std::vector<check::Settled> settle_and_explain(check::SceneVerdict& verdict, const CheckOptions& o,
                                               const std::vector<check::Expectation>& expectations,
                                               std::chrono::sys_days today) {
  std::vector<std::string> asked = o.against;
  if (!o.golden.empty()) asked.emplace_back("golden");
  if (o.fault.empty()) asked.emplace_back("picture");
  std::vector<check::Settled> out = check::settle_expectations(expectations, asked, today, verdict);
  std::string lines;
  for (const check::Settled& settled : out) {
    if (settled.fate != check::Settlement::occurred) lines += settled.line + "\n";
  }
  const std::vector<Stage> nobody = unjudged(verdict, o);
  const bool fails = std::ranges::any_of(verdict.comparisons, [&](const check::Comparison& c) {
    return is_failure(c.outcome) && !(o.allow_missing && c.outcome == check::Outcome::missing);
  });
  if (lines.empty() && nobody.empty() && !fails) return out;
  verdict.repeat = repeat_command(o, verdict);
  const std::string rows = report::failure_lines(verdict, nobody, verdict.repeat);
  verdict.failure = lines + (rows.empty() ? fmt::format("  repeat: {}\n", verdict.repeat) : rows);
  return out;
}

std::string settled_line(const std::vector<check::Settled>& settled, std::size_t expectations) {
  const auto count = [&](check::Settlement fate) { return std::ranges::count(settled, fate, &check::Settled::fate); };
  return fmt::format("expectations: {} occurred, {} expired, {} passed unexpectedly, {} match nothing, {} not asked\n",
                     count(check::Settlement::occurred), count(check::Settlement::expired),
                     count(check::Settlement::passed), count(check::Settlement::unmatched),
                     expectations - settled.size());
}

void RunFailures::add(const check::SceneVerdict& verdict, std::string failure) {
  for (const check::Comparison& row : verdict.comparisons) {
    const std::size_t end = row.note.find('\n');
    if (row.outcome != check::Outcome::failed || end == std::string::npos) continue;
    const std::string rest = row.note.substr(end);
    const auto [first, is_new] = first_.try_emplace(rest, verdict.scene);
    const std::size_t at = failure.find(rest);
    if (!is_new && first->second != verdict.scene && at != std::string::npos)
      failure.replace(at, rest.size(), fmt::format("; its stderr is that of {}", first->second));
  }
  text_ += failure;
}

std::string leave_report(const std::string& folder, const Scene& scene, const check::SceneVerdict& verdict,
                         Renderer& candidate, std::span<const check::Reference> references) {
  const std::filesystem::path to = std::filesystem::path(folder) / report::file_name(verdict.scene);
  report::HtmlReport page(to);
  check::BothCaptures drawn;
  check::judge(scene, candidate, references, &drawn);
  page.add(verdict, references, drawn, scene, verdict.failure, verdict.repeat);
  page.write(verdict.failure);
  std::string out = fmt::format("  report: {}\n", (to / "index.html").string());
  if (std::getenv("CTEST_INTERACTIVE_DEBUG_MODE") == nullptr) return out;  // which CTest alone sets, in all its modes
  const auto attach = [&](const std::string& name, const Plane<glm::vec4>& color) {
    if (color.empty()) return;
    const std::filesystem::path file = std::filesystem::absolute(to.string() + "-" + name + ".png");
    write_image(file, color);
    out += fmt::format("<CTestMeasurementFile type=\"image/png\" name=\"{}\">{}</CTestMeasurementFile>\n", name,
                       file.string());
  };
  attach("ours", drawn.candidate.planes.color);
  for (std::size_t i = 0; i < drawn.references.size(); ++i) {
    attach(references[i].name, drawn.references[i].planes.color);
  }
  return out;
}

void leave_rows(const std::string& folder, const check::SceneVerdict& verdict, const std::string& failure,
                std::string_view word) {
  const std::filesystem::path file = std::filesystem::path(folder) / (report::file_name(verdict.scene) + ".txt");
  std::error_code none;  // what cannot be written says so below
  std::filesystem::create_directories(file.parent_path(), none);
  write_file(file, fmt::format("{}{}\n{}{}\n", report::table_head(), report::table_rows(verdict), failure,
                               !word.empty()             ? word
                               : verdict.failure.empty() ? "holds"
                                                         : "FAILED"));
}

}  // namespace plumbline::cli

#include "cli/campaign_judge.h"

#include <algorithm>
#include <chrono>
#include <regex>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/atomic_path.h"
#include "base/utf8.h"
#include "campaign/shrink.h"
#include "campaign/states/states.h"
#include "cli/options/renderers.h"
#include "report/text/conformance.h"
#include "scene/file/scene_file.h"

namespace plumbline::cli {

namespace {

// Whether the finding is a time-out: each trial may take the whole time limit.
bool hangs(const campaign::Signature& signature) { return signature.cause.find("took longer") != std::string::npos; }

// Field without its component: "p_clip.x" and "p_clip.y" count as one bug.
std::string without_component(std::string_view field) {
  const std::size_t dot = field.rfind('.');
  return std::string(dot != field.npos && dot + 2 == field.size() ? field.substr(0, dot) : field);
}

// The text's first 100 letters without what varies from scene to scene: the pass is removed, numbers become "#".
std::string without_numbers(const std::string& text) {
  static const std::regex pass("^pass [0-9]+: "), number("0x[0-9a-fA-F]+|[0-9]+");
  std::string out = std::regex_replace(std::regex_replace(text, pass, ""), number, "#").substr(0, 100);
  std::ranges::replace(out, '\n', ' ');
  return as_utf8(out);
}

// Row that stands for all of its stage and outcome: one of per_stage before from_scene before legal; else `row`. So a
// bug has one signature, not one for each judge.
const check::Comparison& strongest(const check::SceneVerdict& verdict, const check::Comparison& row) {
  for (const check::Kind kind : {check::Kind::per_stage, check::Kind::from_scene, check::Kind::legal}) {
    for (const check::Comparison& other : verdict.comparisons) {
      if (other.stage == row.stage && other.outcome == row.outcome && other.judge.kind == kind) return other;
    }
  }
  return row;
}

// Removes the program's command line from a failure's text, "COMMAND took longer than ...". `command` may be empty.
std::string without_command(std::string text, const std::string& command) {
  const std::size_t at = command.empty() ? text.npos : text.find(command + " ");
  return at == text.npos ? text : text.erase(at, command.size() + 1);
}

// A failure's text without the end of the program's stderr, which tells of other scenes, too. Of a program that ended
// without a signal, with the last line of it: the exception's.
std::string without_stderr(const std::string& text) {
  constexpr std::string_view kStderr = "\nthe end of its stderr:\n";
  const std::size_t at = text.find(kStderr);
  if (at == text.npos) return text;
  const std::string what = text.substr(0, at);
  if (what.find("exited with status") == what.npos || what.find("signal") != what.npos) return what;
  const std::size_t end = text.find_last_not_of(" \n"), last = text.rfind('\n', end);
  return end < at + kStderr.size() ? what : what + ": " + text.substr(last + 1, end - last);
}

std::string cause_of(const check::Comparison& row, const std::string& command) {
  std::string out(check::name_of(row.outcome));
  if (row.outcome != check::Outcome::different)
    return row.note.empty() ? out : out + ": " + without_numbers(without_stderr(without_command(row.note, command)));
  if (!row.measurement.mismatch.empty()) return out + " (nothing fits)";
  const std::string field = without_component(row.measurement.worst.place.field);
  return field.empty() ? out : out + " " + field;
}

}  // namespace

std::optional<campaign::Signature> signature_of(const check::SceneVerdict& verdict, const std::string& command) {
  if (verdict.failure.empty()) return std::nullopt;
  const check::Comparison* row = check::first_different(verdict);
  if (row != nullptr) row = &strongest(verdict, *row);
  if (row == nullptr) {
    const auto fails = [](const check::Comparison& c) { return is_failure(c.outcome); };
    const auto first = std::ranges::find_if(verdict.comparisons, fails);
    if (first == verdict.comparisons.end()) {
      const std::vector<Stage> nobody = check::unjudged_stages(verdict);
      return campaign::Signature{nobody.empty() ? "none" : std::string(name_of(nobody.front())), "nobody judged it",
                                 ""};
    }
    row = &*first;
  }
  return campaign::Signature{std::string(name_of(row->stage)), cause_of(*row, command), check::title_of(row->judge)};
}

CampaignJudge::CampaignJudge(const CheckRules& rules, Progress& progress, std::filesystem::path scratch)
    : rules_(&rules), progress_(&progress), scratch_(std::move(scratch)), all_(rules, progress) {}

std::filesystem::path CampaignJudge::write(const std::string& name, const std::string& text) const {
  std::filesystem::path file = scratch_ / (name + ".json");
  std::filesystem::create_directories(file.parent_path());
  write_file(file, text);
  return file;
}

campaign::Entry CampaignJudge::judge(const campaign::SceneId& id, EndedSteps ended) {
  const std::filesystem::path file = write(to_string(id), campaign::scene_text(id));
  const Scene scene = rules_->options.scene_arguments.load_silently(file);
  const auto start = std::chrono::steady_clock::now();
  check::BothCaptures drawn;
  const check::SceneVerdict verdict = all_.judge(scene, std::move(ended), &drawn).verdict;
  campaign::Entry out{id, {}, {}};
  if (report::conformance_of(verdict) == report::Conformance::unable)
    out.unable = without_numbers(report::unable_reason(verdict));
  out.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  if (out.unable.empty()) out.states = campaign::states_of(scene, drawn.candidate);
  std::filesystem::remove(file);
  if (auto signature = cli::signature_of(verdict, rules_->options.candidate.command))
    out.found.push_back(std::move(*signature));
  for (const check::Comparison& row : verdict.comparisons) {
    if (row.outcome != check::Outcome::dispute) continue;
    out.disputes.push_back({std::string(name_of(row.stage)), row.measurement.reason, check::title_of(row.judge)});
  }
  std::ranges::sort(out.disputes);
  out.disputes.erase(std::unique(out.disputes.begin(), out.disputes.end()), out.disputes.end());
  return out;
}

std::optional<campaign::Signature> CampaignJudge::signature_of(SceneJudge& judge, const std::string& text) {
  try {
    const Scene scene = rules_->options.scene_arguments.load_silently(write("shrink/scene", text));
    return cli::signature_of(judge.judge(scene, {}).verdict, rules_->options.candidate.command);
  } catch (const SceneError&) {
    return std::nullopt;  // no scene is left
  }
}

std::string CampaignJudge::shrink(const campaign::SceneId& id, const campaign::Signature& signature) {
  const int trials = hangs(signature) ? 10 : 400;  // by one judge
  const auto smaller = [&](SceneJudge& judge, const std::string& text) {
    const auto shows = [&](const std::string& scene) { return signature_of(judge, scene) == signature; };
    return shows(text) ? campaign::shrink(text, shows, trials) : text;
  };
  const std::string text = campaign::scene_text(id),
                    reference = signature.reference.substr(0, signature.reference.find(','));
  if (hangs(signature) || std::ranges::count(known_reference_names(), reference) == 0) return smaller(all_, text);
  CheckRules of_one{rules_->options, rules_->today};
  of_one.names_causes = false;
  of_one.options.against = {reference};
  SceneJudge its_own(of_one, *progress_);
  const std::string by_one = smaller(its_own, text);
  return smaller(all_, signature_of(all_, by_one) == signature ? by_one : text);
}

}  // namespace plumbline::cli

#include "cli/scene_judge.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/same_bits.h"
#include "check/diagnose/diagnose.h"
#include "check/golden/golden.h"
#include "check/judge/judge.h"
#include "cli/check_failures.h"
#include "cli/likely/lookalikes.h"
#include "cli/options/program_argument.h"
#include "cli/options/renderers.h"
#include "report/text/conformance.h"

namespace plumbline::cli {

namespace {

// The frame that the program draws when it is started for this scene alone; none: it fails, refuses the scene, or is
// slow.
std::optional<Planes> drawn_alone(ProgramArgument program, const Scene& scene) {
  program.probes = false;
  program.time_limit = std::min(program.time_limit, std::chrono::seconds(10));
  try {
    return make_program(program)->capture(scene, Request{}).planes;
  } catch (const RendererFailed&) {
    return std::nullopt;
  } catch (const Unsupported&) {
    return std::nullopt;
  }
}

// Causes that the records of the first stage that is wrong by itself show (check/diagnose/known_causes.h). None where
// no row judges records, or the scene is not is_small().
std::vector<std::string> causes_by_records(const Scene& scene, Renderer& candidate, const check::SceneVerdict& verdict,
                                           std::span<const check::Reference> references) {
  const auto is_wrong_by_itself = [](const check::Comparison& row) {
    return row.judge.kind == check::Kind::per_stage && row.outcome == check::Outcome::different;
  };
  const auto is_exact = [](const check::Reference& r) { return r.renderer && is_referee(r.renderer->info()); };
  const auto exact = std::ranges::find_if(references, is_exact);
  const bool is_wrong = std::ranges::any_of(verdict.comparisons, is_wrong_by_itself);
  if (exact == references.end() || !is_wrong || !is_small(scene)) return {};
  const check::Diagnosis diagnosis = check::diagnose(scene, candidate, std::span(&*exact, 1));
  std::vector<std::string> out;
  if (diagnosis.findings.empty()) return out;
  const check::Finding& first = diagnosis.findings.front();
  for (const std::string& kind : first.kinds) out.push_back(fmt::format("{} ({})", name_of(first.stage), kind));
  return out;
}

// Likely causes of a program's wrong or failed scene: state or unset memory, where the program draws the scene
// otherwise when started for it alone; else known faults; else what its records show.
std::vector<std::string> causes_of(const CheckOptions& o, const Scene& scene, const Capture& left, Renderer& candidate,
                                   const check::SceneVerdict& verdict, std::span<const check::Reference> references) {
  const RendererInfo& renderer = candidate.info();
  const report::Conformance ended = report::conformance_of(verdict);
  const bool is_wrong = ended == report::Conformance::differs, is_failed = ended == report::Conformance::failed;
  if (!is_wrong && !is_failed) return {};
  if (!o.seeks_causes) return {"known faults are not sought, by --no-causes"};
  if (antialiased(scene)) return {"known faults are not sought where passes are drawn, not the scene"};
  const std::optional<Planes> alone = drawn_alone(o.candidate, scene);
  const bool left_nothing = verdict.comparisons.front().judge.reference == renderer.name;
  if (alone && is_failed && left_nothing) return {"drawn by the program when it is started for this scene alone"};
  if (is_failed) return {};
  const bool is_alike =
      !alone || (have_same_bits(left.planes.color, alone->color) && have_same_bits(left.planes.depth, alone->depth));
  if (is_alike) {
    const std::vector<std::string> faults = likely_faults(scene, left, renderer, verdict);
    return faults.empty() ? causes_by_records(scene, candidate, verdict, references) : faults;
  }
  return {"drawn otherwise by the program when it is started for this scene alone"};
}

}  // namespace

SceneJudge::SceneJudge(const CheckRules& rules, Progress& progress)
    : rules_(&rules), progress_(&progress), kept_(rules.kept) {}

JudgedScene SceneJudge::judge(const Scene& scene, EndedSteps ended, check::BothCaptures* to_hand_out) {
  const CheckOptions& o = rules_->options;
  ended_ = std::move(ended);
  if (!candidate_) {  // not in the constructor: making a renderer is a step that may be in ended_
    const Watch watch{progress_, &ended_, o.limits.step};
    Watch of_candidate = watch;
    const bool outside = !o.candidate.command.empty();
    if (outside) of_candidate.limit += kOwnProcessLimit;  // a program has a time limit of its own
    candidate_ = make_watched(
        outside ? make_program(o.candidate) : make_candidate(faulted_reference(o.fault).empty() ? o.fault : ""), 0,
        of_candidate);
    references_ = make_references(o.against, o.scene_arguments.assets, watch, o.fault);
  }
  JudgedScene out;
  check::BothCaptures drawn;
  const bool outside = !o.candidate.command.empty();
  check::BothCaptures* wanted = rules_->page || outside || to_hand_out != nullptr ? &drawn : nullptr;
  const References& asked = references_;
  out.verdict = kept_ && ended_.empty()
                    ? check::judge_or_recall(scene, *candidate_, asked.list, *kept_, wanted, asked.arbiters)
                    : check::judge(scene, *candidate_, asked.list, wanted, ~std::uint64_t{0}, asked.arbiters);
  check::SceneVerdict& verdict = out.verdict;
  if (outside && rules_->names_causes)
    verdict.causes = causes_of(o, scene, drawn.candidate, *candidate_, verdict, references_.list);
  if (rules_->goldens)
    std::ranges::move(check::golden_rows(scene, *candidate_, *rules_->goldens),
                      std::back_inserter(verdict.comparisons));
  out.settled = settle_and_explain(verdict, o, rules_->expectations, rules_->today);
  if (!verdict.failure.empty() && !verdict.causes.empty() && verdict.causes.front().starts_with("drawn "))
    verdict.failure += fmt::format("  {}: the command may not repeat it\n", verdict.causes.front());
  out.failure = verdict.failure;
  if (!verdict.failure.empty() && !o.failures.empty()) {
    out.failure += leave_report(o.failures, scene, verdict, *candidate_, references_.list);
  }
  if (rules_->page) {
    out.drawing = rules_->page->draw(verdict, references_.list, drawn, scene, verdict.failure, verdict.repeat);
  }
  out.versions = versions_of(*candidate_, references_);
  if (to_hand_out != nullptr) *to_hand_out = std::move(drawn);
  return out;
}

JudgedScene not_compared(const Scene& scene, const CheckRules& rules, const std::string& how) {
  JudgedScene out;
  out.verdict.scene = scene.name;
  out.verdict.path = scene.path;
  out.verdict.comparisons = {
      check::not_judged(scene.name, "comparison", Stage::merge, check::Outcome::failed, "the comparison " + how)};
  out.settled = settle_and_explain(out.verdict, rules.options, rules.expectations, rules.today);
  out.failure = out.verdict.failure;
  return out;
}

}  // namespace plumbline::cli

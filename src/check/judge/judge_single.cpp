#include "check/judge/judge_single.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "check/bounds/open_pixels.h"
#include "check/judge/captures.h"
#include "check/judge/failing_stage.h"
#include "check/judge/judge_records.h"
#include "check/judge/rotate_corners.h"
#include "check/judge/rows.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/unit_normals.h"
#include "check/verdict/votes.h"

namespace plumbline::check {

namespace {

// Row `failed` of a candidate whose capture failed, at the failing stage (unknown: at merge). `shown` keeps the stages
// that are before the failing stage and before coverage; none if the failing stage is unknown.
Comparison candidate_failed(const Scene& scene, Renderer& candidate, Renderer* referee, const std::string& how,
                            RendererInfo& shown) {
  const auto at = referee == nullptr ? std::nullopt : failing_stage(scene, candidate, *referee);
  const Stage stage = at ? at->stage : Stage::merge;
  for (const Stage each : kAllStages) {
    if (at && each < std::min(stage, Stage::coverage)) continue;
    shown[each] = {.reason = fmt::format("{} failed at stage {}", shown.name, name_of(stage))};
  }
  return not_judged(scene.name, shown.name, stage, Outcome::failed, at ? at->how : how);
}

// Stages texture and visibility as the referee makes them: other rows need the legal texels, and which fragments are
// drawn. Where the referee fails, the referee's own row reports the failure.
MadeStages make_stages(const Scene& scene, const Capture& candidate, Renderer& referee,
                       const Conventions& conventions) {
  MadeStages made;
  for (const Stage stage : {Stage::texture, Stage::visibility}) {
    if (!referee.info()[stage].runs || !has_stage(scene, stage)) continue;
    try {
      made.emplace(stage, run_by_conventions(referee, scene, stage, candidate, conventions));
    } catch (const std::exception&) {
    }
  }
  return made;
}

// While alive, replaces the candidate's `drawn` by the referee's tests of the candidate's earlier records, so that a
// wrongly drawn fragment leaves nothing open.
class DrawnAsMade {
 public:
  DrawnAsMade(Capture& candidate, MadeStages& made) : candidate_(candidate), visibility_(made.find(Stage::visibility)) {
    known_ = visibility_ != made.end();
    swap();
  }
  DrawnAsMade(const DrawnAsMade&) = delete;
  DrawnAsMade& operator=(const DrawnAsMade&) = delete;
  ~DrawnAsMade() { swap(); }

 private:
  void swap() {
    if (known_) candidate_.records.drawn.swap(visibility_->second.records.drawn);
  }
  Capture& candidate_;
  MadeStages::iterator visibility_;
  bool known_;
};

// The last reference that judges single stages and answered; null: there is none.
Renderer* answering_referee(std::span<const Reference> references, const ReferenceCaptures& answers) {
  Renderer* out = nullptr;
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (!answers.refusals[i] && is_referee(references[i].renderer->info())) out = references[i].renderer;
  }
  return out;
}

// The first legal answers of the whole frame; null: nobody gave any.
const Legal* first_legal(const ReferenceCaptures& answers) {
  const auto first = std::ranges::find_if(answers.captures, [](const Capture& c) { return !c.legal.empty(); });
  return first != answers.captures.end() ? &first->legal : nullptr;
}

}  // namespace

SceneVerdict judge_single(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn, std::uint64_t most_fragments) {
  const auto start = std::chrono::steady_clock::now();
  SceneVerdict verdict{scene.name, scene.path, {}, 0};
  const auto nothing = [&](const std::string& name, const Refusal& refusal) {
    verdict.comparisons.push_back(not_judged(scene.name, name, Stage::merge, refusal.outcome, refusal.why));
  };
  Capture mine;  // no reference draws a scene too large to judge
  const std::optional<Refusal> refusal =
      refusal_within_budget([&] { mine = capture_all(scene, candidate, most_fragments); });
  RendererInfo shown = candidate.info();  // of a program: what it left of this scene
  const Conventions conventions = shown.conventions;
  const bool foreign = shown.profile == Profile::foreign, drew = !refusal;
  if (!drew && (foreign || refusal->outcome == Outcome::unsupported)) {  // a foreign one runs no single stages
    nothing(shown.name, *refusal);
    return verdict;
  }
  const SceneByConventions seen(scene, conventions);
  ReferenceCaptures answers =
      capture_references(scene, references, !drew || !more_than(most_fragments, mine), conventions);
  Renderer* const referee = answering_referee(references, answers);
  const Legal* legal = first_legal(answers);
  Legal where_apart;
  MadeStages made;
  if (!drew) {
    verdict.comparisons.push_back(candidate_failed(scene, candidate, referee, refusal->why, shown));
    mine = run_alone(scene, candidate, shown);
  } else if (referee != nullptr) {
    if (foreign) {
      // Fragments are lit by interpolated normals, whose lengths count.
      mine.records = with_unit_normals(scene, std::move(mine.records), OfDraws::lit_at_vertices);
      rotate_as_made(*seen, shown, *referee, mine);
    }
    if (legal == nullptr && referee->info().legal)
      where_apart = legal_where_apart(scene, mine, answers.captures, *referee, conventions);
    made = make_stages(*seen, mine, *referee, conventions);
    // Comparators read the legal texels of the candidate's fragments beside its records.
    if (const auto filtered = made.find(Stage::texture); filtered != made.end())
      mine.legal.texels = filtered->second.legal.texels;
  }
  if (legal == nullptr) legal = &where_apart;
  verdict.empty_holds = may_be_empty(*legal);
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (answers.refusals[i]) {
      nothing(references[i].name, *answers.refusals[i]);
      continue;
    }
    Renderer& reference = *references[i].renderer;
    try {
      const RendererInfo info = reference.info();
      const SceneJudgement c{.scene = *seen,
                             .candidate = mine,
                             .legal = *legal,
                             .referee = referee,
                             .rows = verdict.comparisons,
                             .profile = info.profile,
                             .foreign = foreign,
                             .conventions = conventions};
      {
        const DrawnAsMade drawn_as_made(mine, made);
        judge_from_scene(c, answers.captures[i], info, shown);
      }
      if (is_referee(info)) {
        const MadeStages none;
        std::ranges::move(judge_records(*seen, mine, reference, &shown, &reference == referee ? made : none, *legal),
                          std::back_inserter(verdict.comparisons));
      }
    } catch (const std::exception& e) {
      nothing(references[i].name, {Outcome::failed, e.what()});
    }
  }
  if (foreign) leave_recipes_to_exact(verdict.comparisons);
  settle_votes(verdict.comparisons, is_plain(*seen));
  if (drew && !shown.painters.empty() && shown[Stage::merge].shows)
    verdict.comparisons.push_back(judge_picture(scene, candidate, mine));
  verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (drawn != nullptr) {
    if (drew) drawn->candidate = std::move(mine);
    drawn->references = std::move(answers.captures);
  }
  return verdict;
}

}  // namespace plumbline::check

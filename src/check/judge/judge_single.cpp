#include "check/judge/judge_single.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "check/bounds/open_pixels.h"
#include "check/judge/foreign_records.h"
#include "check/judge/judge_records.h"
#include "check/judge/rows.h"
#include "check/judge/run_by_conventions.h"
#include "check/verdict/votes.h"

namespace plumbline::check {

namespace {

// Row `failed` of a candidate whose capture failed, at the stage that fails alone; merge where no stage does. `shown`:
// keeps the stages before the failing stage and before coverage; none where the failing stage is unknown.
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

// Replaces the candidate's `drawn`, while alive, by the referee's tests of the candidate's earlier records: a fragment
// that the candidate drew wrongly then leaves nothing open.
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

// Inputs of a scene's judgement, beside the references' captures.
struct JudgementInputs {
  RendererInfo shown;            ///< of the candidate, for this scene
  Capture mine;                  ///< the candidate's
  Renderer* referee = nullptr;   ///< makes single stages; null: none
  Legal where_apart;             ///< legal answers at some pixels, where no reference gave those of the frame
  const Legal* legal = nullptr;  ///< never null once prepared
  MadeStages made;               ///< stages that the referee has made of `mine`
};

// Brings a foreign candidate's records into the form that comparators read, and adds what the referee makes of them.
void prepare(const Scene& scene, const Scene& seen, const ReferenceCaptures& theirs, JudgementInputs& b) {
  Renderer& referee = *b.referee;
  const Conventions& conventions = b.shown.conventions;
  if (b.shown.profile == Profile::foreign) {
    // Fragments are lit by interpolated normals, whose lengths count.
    b.mine.records = with_unit_normals(scene, std::move(b.mine.records), OfDraws::lit_at_vertices);
    rotate_as_made(seen, b.shown, referee, b.mine);
  }
  if (b.legal == nullptr && referee.info().legal)
    b.where_apart = legal_where_apart(scene, b.mine, theirs.captures, referee, conventions);
  b.made = make_stages(seen, b.mine, referee, conventions);
  // Comparators read the legal texels of the candidate's fragments beside its records.
  if (const auto filtered = b.made.find(Stage::texture); filtered != b.made.end())
    b.mine.legal.texels = filtered->second.legal.texels;
}

// Appends the rows of one reference.
void add_rows(const Scene& seen, Renderer& reference, const Capture& theirs, JudgementInputs& b,
              SceneVerdict& verdict) {
  const RendererInfo info = reference.info();
  const SceneJudgement c{.scene = seen,
                         .candidate = b.mine,
                         .legal = *b.legal,
                         .referee = b.referee,
                         .rows = verdict.comparisons,
                         .profile = info.profile,
                         .foreign = b.shown.profile == Profile::foreign,
                         .conventions = b.shown.conventions};
  {
    const DrawnAsMade drawn_as_made(b.mine, b.made);
    judge_from_scene(c, theirs, info, b.shown);
  }
  if (!is_referee(info)) return;
  const MadeStages none;
  std::ranges::move(judge_records(seen, b.mine, reference, &b.shown, &reference == b.referee ? b.made : none, *b.legal),
                    std::back_inserter(verdict.comparisons));
}

}  // namespace

SceneVerdict judge_single(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn, std::uint64_t most_fragments) {
  const auto start = std::chrono::steady_clock::now();
  SceneVerdict verdict{scene.name, scene.path, {}, 0};
  const auto nothing = [&](const std::string& name, const Refusal& refusal) {
    verdict.comparisons.push_back(not_judged(scene.name, name, Stage::merge, refusal.outcome, refusal.why));
  };
  JudgementInputs b;  // no reference draws a scene too large to judge
  const std::optional<Refusal> refusal =
      refusal_within_budget([&] { b.mine = capture_all(scene, candidate, most_fragments); });
  b.shown = candidate.info();  // of a program: what it left of this scene
  const bool foreign = b.shown.profile == Profile::foreign, drew = !refusal;
  if (!drew && (foreign || refusal->outcome == Outcome::unsupported)) {  // a foreign one runs no single stages
    nothing(b.shown.name, *refusal);
    return verdict;
  }
  const SceneByConventions seen(scene, b.shown.conventions);
  const bool wants_legal = !drew || !more_than(most_fragments, b.mine);
  ReferenceCaptures theirs = capture_references(scene, references, wants_legal, b.shown.conventions);
  b.referee = answering_referee(references, theirs);
  b.legal = first_legal(theirs);
  if (!drew) {
    verdict.comparisons.push_back(candidate_failed(scene, candidate, b.referee, refusal->why, b.shown));
    b.mine = run_alone(scene, candidate, b.shown);
  } else if (b.referee != nullptr) {
    prepare(scene, *seen, theirs, b);
  }
  if (b.legal == nullptr) b.legal = &b.where_apart;
  verdict.empty_holds = may_be_empty(*b.legal);
  verdict.knows_no_color = knows_no_color(*b.legal);
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (theirs.refusals[i]) {
      nothing(references[i].name, *theirs.refusals[i]);
      continue;
    }
    try {
      add_rows(*seen, *references[i].renderer, theirs.captures[i], b, verdict);
    } catch (const std::exception& e) {
      nothing(references[i].name, {Outcome::failed, e.what()});
    }
  }
  if (foreign) leave_recipes_to_exact(verdict.comparisons);
  settle_votes(verdict.comparisons, is_plain(*seen));
  if (drew && !b.shown.painters.empty() && b.shown[Stage::merge].shows)
    verdict.comparisons.push_back(judge_picture(scene, candidate, b.mine));
  verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (drawn != nullptr) {
    if (drew) drawn->candidate = std::move(b.mine);
    drawn->references = std::move(theirs.captures);
  }
  return verdict;
}

}  // namespace plumbline::check

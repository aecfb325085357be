#include "check/judge/judge_single.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "check/bounds/open_pixels.h"
#include "check/compare/compare_bits.h"
#include "check/compare/compare_records.h"
#include "check/compare/compare_texels.h"
#include "check/judge/failing_stage.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/scene_case.h"
#include "check/judge/stage_copy.h"
#include "check/judge/stage_inputs.h"
#include "check/judge/turn_triangles.h"
#include "check/verdict/votes.h"

namespace plumbline::check {

namespace {

// An oracle hands out the final colour, which is the interpolated one where all draws are plain.
StageSet oracle_stages(const Scene& scene) {
  return {Stage::coverage, Stage::depth, is_plain(scene) ? Stage::attributes : Stage::shade, Stage::visibility,
          Stage::merge};
}

constexpr StageSet kGeometry{Stage::matrices, Stage::vertex, Stage::light, Stage::clip, Stage::window};

// Rows of a reference that draws the scene: records and planes side by side, coverage to colour by an oracle's answers.
void judge_from_scene(Case& c, const Capture& theirs, const RendererInfo& info, const RendererInfo& candidate) {
  const bool exact = is_referee(info);
  const JudgeId name(info.name, exact ? Kind::from_scene : info.legal ? Kind::legal : Kind::side_by_side);
  const StageSet of_oracle = oracle_stages(c.scene);
  const Inversion inversion = c.foreign ? Inversion::in_float : Inversion::in_double;
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::resolve || (stage == Stage::texture && !textured(c.scene))) continue;
    if (candidate[stage].contradicted) {
      c.skip(name, stage, Outcome::failed, candidate[stage].reason);
    } else if (!candidate[stage].shows) {
      c.skip(name, stage, Outcome::unsupported, candidate[stage].reason);
    } else if (info.legal && of_oracle.has(stage) && theirs.legal.empty()) {
      c.skip(name, stage, Outcome::unsupported,
             draws_lines_or_points(c.scene) ? "its legal answers are of triangles alone"
                                            : "too many fragments for legal answers");
    } else if (info.legal && of_oracle.has(stage) && !has_plane(c.candidate.planes, stage)) {
      c.skip(name, stage, Outcome::unsupported, "it shows no plane of it");
    } else if (info.legal && of_oracle.has(stage)) {
      ask_oracle(c, theirs.legal, stage, name);
    } else if (const std::string lacking = lacking_beside(c.scene, c.candidate.planes, candidate, stage);
               !lacking.empty()) {
      c.skip(name, stage, Outcome::unsupported, lacking);
    } else if (exact && stage == Stage::matrices) {
      const Records<double>& mine = c.candidate.records;
      const Tolerance& row = tolerance(Profile::exact, stage);
      c.add(name, stage,
            worse(compare_matrices(mine, theirs.records, row.factor, inversion),
                  compare_lights(c.scene, mine, theirs.records, row.factor)),
            &row);
    } else if (exact && stage == Stage::vertex) {
      const Tolerance& row = tolerance(Profile::exact, stage, "scene");
      c.add(name, stage,
            compare_vertices(c.scene, c.candidate.records, theirs.records, row.factor, row.factor, inversion), &row);
    } else if (!exact && draws_otherwise(candidate.conventions, stage)) {
      c.skip(name, stage, Outcome::unsupported, "it draws by other conventions: oracles and exact judge the stage");
    } else if (!info[stage].shows) {
      c.skip(name, stage, Outcome::unsupported, info[stage].reason);
    } else if (stage == Stage::attributes && info.legal && !exact) {
      c.skip(name, stage, Outcome::unsupported, kOnlyShaded);
    } else if (stage == Stage::shade && info.legal && !exact) {
      c.repeat(name, Stage::attributes, stage);
    } else if (!exact && lacks_texels(c, stage)) {
      c.skip(name, stage, Outcome::unsupported,
             lacks_fragment_records(c.candidate) ? kOverBudget
                                                 : "which levels of detail are legal, exact says: it is not asked");
    } else if (!exact && stage > Stage::coverage && tests_alpha(c.scene)) {
      if (lacks_fragment_records(c.candidate)) {
        c.skip(name, stage, Outcome::unsupported, kOverBudget);
        continue;
      }
      Capture settled = theirs;
      c.open = copy_pixels_open_by_alpha(c.scene, c.candidate, stage, tolerance(info.profile, Stage::attributes).factor,
                                         settled);
      side_by_side(c, settled, stage, name);
      c.open = 0;
    } else if (!exact) {
      side_by_side(c, theirs, stage, name);
    }  // An exact reference judges the other stages from the candidate's own records.
  }
}

bool more_than(std::uint64_t most_fragments, const Capture& capture) {
  const auto& count = capture.planes.count.values();
  return std::accumulate(count.begin(), count.end(), std::uint64_t{0}) > most_fragments;
}

// All records and planes; without records of fragments where these are too many or do not fit the memory budget.
Capture capture_all(const Scene& scene, Renderer& renderer, std::uint64_t most_fragments) {
  try {
    if (most_fragments != ~std::uint64_t{0}) {
      Capture counted = renderer.capture(scene, {kGeometry, false, {}, {}});
      if (more_than(most_fragments, counted)) return counted;
    }
    return renderer.capture(scene, {StageSet::all(), false, {}, {}});
  } catch (const OverBudget&) {
    return renderer.capture(scene, {kGeometry, false, {}, {}});
  }
}

// A reference's capture: geometry records; coverage records where lines are drawn; planes, except of a referee and of
// an oracle that is not asked for legal answers; legal answers, where they are asked for and fit the budget.
Capture capture_reference(const Scene& scene, Renderer& renderer, bool legal, const Conventions& conventions) {
  const RendererInfo info = renderer.info();
  Request request{kGeometry, legal && info.legal, {}, {}};
  request.conventions = conventions;
  if (draws(scene, Topology::lines)) request.records.add(Stage::coverage);  // which line covers what
  if (is_referee(info) || (info.legal && !legal)) request.planes = WantedPlanes::none;
  try {
    return renderer.capture(scene, request);
  } catch (const OverBudget&) {
    request.legal = false;
    return renderer.capture(scene, request);
  }
}

// Legal answers at the pixels where a reference has another winner than the candidate; empty where the oracle fails.
Legal legal_where_apart(const Scene& scene, const Capture& mine, std::span<const Capture> theirs, Renderer& oracle,
                        const Conventions& conventions) {
  Request request{{}, true, {}, {}};
  request.conventions = conventions;
  request.planes = WantedPlanes::none;
  const auto apart = [&](int x, int y) {
    return std::ranges::any_of(theirs, [&](const Capture& c) {
      return c.planes.id.size() == mine.planes.id.size() && c.planes.id(x, y) != mine.planes.id(x, y);
    });
  };
  for (int y = 0; y < mine.planes.id.height(); ++y) {
    for (int x = 0; x < mine.planes.id.width(); ++x) {
      if (apart(x, y)) request.pixels.emplace_back(x, y);
    }
  }
  if (request.pixels.empty()) return {};
  try {
    return oracle.capture(scene, request).legal;
  } catch (const std::exception&) {  // it has nothing to say
    return {};
  }
}

// Row `failed`, at the failing stage, of a candidate whose capture failed. `shown` keeps the stages before that one and
// before coverage; none if the failing stage is unknown.
Comparison candidate_failed(const Scene& scene, Renderer& candidate, Renderer* referee, const std::string& how,
                            RendererInfo& shown) {
  const auto at = referee == nullptr ? std::nullopt : failing_stage(scene, candidate, *referee);
  const Stage stage = at ? at->stage : Stage::merge;
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    if (at && i < static_cast<std::size_t>(std::min(stage, Stage::coverage))) continue;
    shown.stages[i] = {false, false, fmt::format("{} failed at stage {}", shown.name, name_of(stage))};
  }
  return not_judged(scene.name, shown.name, stage, Outcome::failed, at ? at->how : how);
}

// Texture and visibility by the referee: other rows need legal texels, and which fragments are drawn. Where the referee
// fails, its own row says so.
MadeStages make_stages(const Scene& scene, const Capture& candidate, Renderer& referee,
                       const Conventions& conventions) {
  MadeStages made;
  for (const Stage stage : {Stage::texture, Stage::visibility}) {
    if (!referee.info()[stage].runs || (stage == Stage::texture && !textured(scene))) continue;
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

// The records of the stages that `shown` shows, each run alone on those before it.
Capture run_alone(const Scene& scene, Renderer& candidate, RendererInfo& shown) {
  Capture out;
  for (std::size_t i = 0; shown.stages[i].shows; ++i) {
    try {
      copy_stage(static_cast<Stage>(i), candidate.run_stage(scene, static_cast<Stage>(i), out), out);
    } catch (const std::exception& e) {
      for (Ability& later : std::span(shown.stages).subspan(i)) later = {false, false, e.what()};
    }
  }
  return out;
}

}  // namespace

std::vector<Comparison> judge_records(const Scene& scene, const Capture& candidate, Renderer& referee,
                                      const RendererInfo* shown, const MadeStages& made, const Legal& legal) {
  std::vector<Comparison> out;
  Case c{scene, candidate, legal, &referee, out};
  c.foreign = shown != nullptr && shown->profile == Profile::foreign;
  if (shown != nullptr) c.conventions = shown->conventions;
  const RendererInfo info = referee.info();
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    const bool of_none = stage == Stage::matrices || stage == Stage::resolve;
    if (of_none || !info[stage].runs || (stage == Stage::texture && !textured(scene))) continue;
    const JudgeId name(info.name, Kind::per_stage);
    if ((stage == Stage::clip || stage == Stage::window) && has_other_volume(c.conventions)) {
      c.skip(name, stage, Outcome::unsupported, "its view volume is another");
      continue;
    }
    if (shown != nullptr) {
      const std::string lacking = lacking_per_stage(scene, *shown, stage);
      if (!lacking.empty()) {
        c.skip(name, stage, Outcome::unsupported, lacking);
        continue;
      }
    }
    try {
      const auto known = made.find(stage);
      if (known != made.end() && !lacks_fragment_records(candidate)) {
        compare_stage(c, known->second, stage, name);
      } else {
        run_exact_stage(c, referee, stage, name);
      }
      if (shown != nullptr && (*shown)[stage].planes_alone && out.back().note == kOverBudget)
        out.back().note = "by its planes: it shows no records";
    } catch (const OverBudget& e) {
      c.skip(name, stage, Outcome::unsupported, e.what());
    } catch (const std::exception& e) {
      c.skip(name, stage, Outcome::failed, e.what());
    }
  }
  return out;
}

Comparison judge_picture(const Scene& scene, Renderer& candidate, const Capture& watched) {
  const JudgeId kPicture("picture", Kind::picture);
  const Stage stage = scene.frame.antialias.kind == Antialias::Kind::none ? Stage::merge : Stage::resolve;
  try {
    Comparison row;
    for (const std::string& painter : candidate.info().painters) {
      Request request;
      request.planes = WantedPlanes::picture;
      request.painter = painter;
      const Capture shipped = candidate.capture(scene, request);
      row = judged(scene.name, kPicture, stage, compare_picture(scene.frame, shipped.planes, watched.planes));
      if (row.outcome == Outcome::equal) continue;
      row.note = fmt::format("painter {}{}{}", painter, row.note.empty() ? "" : ": ", row.note);
      break;
    }
    return row;
  } catch (const std::exception& e) {
    return not_judged(scene.name, kPicture, stage, Outcome::failed, e.what());
  }
}

SceneVerdict judge_single(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn, std::uint64_t most_fragments) {
  const auto start = std::chrono::steady_clock::now();
  SceneVerdict verdict{scene.name, scene.path, {}, 0};
  const auto nothing = [&](const std::string& name, Outcome outcome, const std::string& why) {
    verdict.comparisons.push_back(not_judged(scene.name, name, Stage::merge, outcome, why));
  };
  std::optional<Capture> mine;
  std::string failure;
  try {
    mine = capture_all(scene, candidate, most_fragments);
  } catch (const OverBudget&) {
    throw;  // no reference draws a scene too large to judge
  } catch (const Unsupported& e) {
    nothing(candidate.info().name, Outcome::unsupported, e.what());
    return verdict;
  } catch (const std::exception& e) {
    failure = e.what();
    if (candidate.info().profile == Profile::foreign) {  // it cannot be asked for single stages
      nothing(candidate.info().name, Outcome::failed, failure);
      return verdict;
    }
  }
  const Conventions conventions = candidate.info().conventions;
  const SceneByConventions seen(scene, conventions);
  std::vector<Capture> theirs(references.size());
  std::vector<std::string> failures(references.size());
  std::vector<Outcome> outcomes(references.size(), Outcome::failed);
  const bool ask_legal = !mine || !more_than(most_fragments, *mine);
  const Legal none;
  const Legal* legal = &none;
  Renderer* referee = nullptr;
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (references[i].renderer == nullptr) {
      failures[i] = "not built in";
      outcomes[i] = Outcome::missing;
      continue;
    }
    try {
      theirs[i] = capture_reference(scene, *references[i].renderer, ask_legal, conventions);
      if (legal->empty()) legal = &theirs[i].legal;
      if (is_referee(references[i].renderer->info())) referee = references[i].renderer;
    } catch (const Unsupported& e) {
      failures[i] = e.what();
      outcomes[i] = Outcome::unsupported;
    } catch (const OverBudget& e) {
      failures[i] = e.what();
      outcomes[i] = Outcome::unsupported;
    } catch (const std::exception& e) {
      failures[i] = e.what();
    }
  }
  RendererInfo mine_info = candidate.info();
  const bool drew = mine.has_value();
  if (drew && referee != nullptr && mine_info.profile == Profile::foreign)
    turn_as_made(*seen, mine_info, *referee, *mine);
  if (!drew) {
    verdict.comparisons.push_back(candidate_failed(scene, candidate, referee, failure, mine_info));
    mine = run_alone(scene, candidate, mine_info);
  }
  Legal somewhere;
  if (drew && legal->empty() && referee != nullptr && referee->info().legal) {
    somewhere = legal_where_apart(scene, *mine, theirs, *referee, conventions);
    legal = &somewhere;
  }
  verdict.empty_holds = may_be_empty(*legal);
  MadeStages made;
  if (drew && referee != nullptr) made = make_stages(*seen, *mine, *referee, conventions);
  if (const auto filtered = made.find(Stage::texture); filtered != made.end()) {
    mine->legal.texels = filtered->second.legal.texels;
  }
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (!failures[i].empty()) {
      nothing(references[i].name, outcomes[i], failures[i]);
    } else {
      Case c{*seen, *mine, *legal, referee, verdict.comparisons};
      c.conventions = conventions;
      try {
        const RendererInfo info = references[i].renderer->info();
        c.profile = info.profile;
        c.foreign = mine_info.profile == Profile::foreign;
        {
          const DrawnAsMade drawn_as_made(*mine, made);
          judge_from_scene(c, theirs[i], info, mine_info);
        }
        if (is_referee(info)) {
          const bool same = references[i].renderer == referee;
          std::ranges::move(
              judge_records(*seen, *mine, *references[i].renderer, &mine_info, same ? made : MadeStages(), *legal),
              std::back_inserter(verdict.comparisons));
        }
      } catch (const std::exception& e) {
        nothing(references[i].name, Outcome::failed, e.what());
      }
    }
  }
  if (mine_info.profile == Profile::foreign) leave_recipes_to_exact(verdict.comparisons);
  settle_votes(verdict.comparisons);
  if (drew && !mine_info.painters.empty() && mine_info[Stage::merge].shows)
    verdict.comparisons.push_back(judge_picture(scene, candidate, *mine));
  verdict.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (drawn != nullptr) {
    if (drew) drawn->candidate = std::move(*mine);
    drawn->references = std::move(theirs);
  }
  return verdict;
}

}  // namespace plumbline::check

#include "check/judge/judge_records.h"

#include <exception>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "capture/by_conventions.h"
#include "capture/require_fitting.h"
#include "check/compare/compare_bits.h"
#include "check/judge/rows.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/stage_inputs.h"

namespace plumbline::check {

namespace {

// Reason why the stage is not judged: a view volume that is not exact's, or conventions whose effect the candidate's
// records do not show. Empty: there is none.
std::string_view why_not(const Scene& scene, Stage stage, const Conventions& conventions) {
  if ((stage == Stage::clip || stage == Stage::window) && has_other_volume(conventions))
    return "its view volume is another";
  if (stage == Stage::shade && fogs_otherwise(scene, conventions))
    return "its fog factors are of vertices, or of |p_eye|: the frame's colours are judged";
  if ((stage == Stage::light || stage == Stage::clip) && has_codes_of_vertices(scene.frame, conventions))
    return "its vertices' colours are codes: the frame's colours are judged";
  return "";
}

}  // namespace

std::vector<Comparison> judge_records(const Scene& scene, const Capture& candidate, Renderer& referee,
                                      const RendererInfo* shown, const MadeStages& made, const Legal& legal) {
  std::vector<Comparison> out;
  const SceneJudgement c{.scene = scene,
                         .candidate = candidate,
                         .legal = legal,
                         .referee = &referee,
                         .rows = out,
                         .foreign = shown != nullptr && shown->profile == Profile::foreign,
                         .conventions = shown != nullptr ? shown->conventions : Conventions()};
  const RendererInfo info = referee.info();
  const JudgeId name(info.name, Kind::per_stage);
  for (const Stage stage : stages_of(scene, Stage::vertex)) {
    if (!info[stage].runs) continue;
    if (const std::string_view reason = why_not(scene, stage, c.conventions); !reason.empty()) {
      c.skip(name, stage, Outcome::unsupported, reason);
      continue;
    }
    if (shown != nullptr) {
      std::string lacking = lacking_per_stage(scene, *shown, stage);
      const auto of = c.foreign ? VaryingsOf::inputs_and_output : VaryingsOf::inputs;
      const std::string varying = lacking_varying(scene, stage, of, candidate);
      if (lacking.empty() && !varying.empty()) lacking = fmt::format("it shows no {}", varying);
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
      if (shown != nullptr && (*shown)[stage].planes_alone && !out.empty() && out.back().note == kOverBudget)
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
  const Stage stage = !antialiased(scene) ? Stage::merge : Stage::resolve;
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

}  // namespace plumbline::check

#include <string>
#include <string_view>

#include "check/bounds/open_pixels.h"
#include "check/compare/compare_records.h"
#include "check/judge/foreign_records.h"
#include "check/judge/rows.h"
#include "check/judge/run_by_conventions.h"
#include "check/judge/stage_inputs.h"

namespace plumbline::check {

namespace {

// Stages that an oracle's legal answers judge. An oracle hands out the final colour: where all draws are plain, that of
// attributes.
StageSet oracle_stages(const Scene& scene) {
  return {Stage::coverage, Stage::depth, is_plain(scene) ? Stage::attributes : Stage::shade, Stage::visibility,
          Stage::merge};
}

void judge_by_oracle(const SceneJudgement& c, const Legal& legal, Stage stage, const JudgeId& name) {
  if (legal.empty()) {
    return c.skip(name, stage, Outcome::unsupported,
                  draws_lines_or_points(c.scene) ? "its legal answers are of triangles alone"
                                                 : "too many fragments for legal answers");
  }
  if (!has_plane(c.candidate.planes, stage))
    return c.skip(name, stage, Outcome::unsupported, "it shows no plane of it");
  compare_with_legal(c, legal, stage, name);
}

// Compares with the referee's matrices and vertices of the scene. The candidate's own records serve for later stages.
void judge_by_referee(const SceneJudgement& c, const Records<double>& theirs, Stage stage, const JudgeId& name) {
  const Records<double>& mine = c.candidate.records;
  const Inversion inversion = c.foreign ? Inversion::in_float : Inversion::in_double;
  if (stage == Stage::matrices) {
    const Tolerance& row = tolerance(Profile::exact, stage);
    c.add(
        name, stage,
        worse(compare_matrices(mine, theirs, row.factor, inversion), compare_lights(c.scene, mine, theirs, row.factor)),
        &row);
  } else if (stage == Stage::vertex) {
    const Tolerance& row = tolerance(Profile::exact, stage, "scene");
    Records<double> changed;  // copy of a foreign candidate's records
    c.add(name, stage, compare_vertices(c.scene, vertex_records(c, changed), theirs, row.factor, row.factor, inversion),
          &row);
  }
}

// Whether the stage's rows side by side need legal texels (fragment_bounds.h) that the capture lacks.
bool lacks_texels(const SceneJudgement& c, Stage stage) {
  const bool of_texels = stage == Stage::texture || stage == Stage::shade || stage == Stage::merge;
  return of_texels && textured(c.scene) && c.candidate.legal.texels.empty();
}

// side_by_side(), or a row that says why nothing is compared.
void judge_beside(const SceneJudgement& c, const Capture& theirs, const RendererInfo& of, Stage stage,
                  const JudgeId& name) {
  const auto skip = [&](std::string_view why) { c.skip(name, stage, Outcome::unsupported, why); };
  if (differs_from_opengl(c.scene, c.conventions, stage))
    return skip("it draws by other conventions: oracles and exact judge the stage");
  if (!of[stage].shows) return skip(of[stage].reason);
  if (of.legal && stage == Stage::attributes) return skip(kOnlyShaded);
  if (of.legal && stage == Stage::shade) return c.repeat(name, Stage::attributes, stage);
  if (lacks_texels(c, stage))
    return skip(lacks_fragment_records(c.candidate) ? kOverBudget : "legal levels of detail need the reference exact");
  if (stage <= Stage::coverage || !tests_alpha(c.scene)) return side_by_side(c, theirs, stage, name);
  if (lacks_fragment_records(c.candidate)) return skip(kOverBudget);
  Capture settled = theirs;
  const std::uint64_t open =
      copy_pixels_open_by_alpha(c.scene, c.candidate, stage, tolerance(of.profile, Stage::attributes).factor, settled);
  side_by_side(c.with_open(open), settled, stage, name);
}

}  // namespace

void judge_from_scene(const SceneJudgement& c, const Capture& theirs, const RendererInfo& of,
                      const RendererInfo& candidate) {
  const bool exact = is_referee(of);
  const JudgeId name(of.name, exact ? Kind::from_scene : of.legal ? Kind::legal : Kind::side_by_side);
  const StageSet by_oracle = of.legal ? oracle_stages(c.scene) : StageSet();
  for (const Stage stage : stages_of(c.scene)) {
    if (candidate[stage].contradicted) {
      c.skip(name, stage, Outcome::failed, candidate[stage].reason);
    } else if (!candidate[stage].shows) {
      c.skip(name, stage, Outcome::unsupported, candidate[stage].reason);
    } else if (by_oracle.has(stage)) {
      judge_by_oracle(c, theirs.legal, stage, name);
    } else if (const std::string lacking = lacking_beside(c.scene, c.candidate.planes, candidate, stage);
               !lacking.empty()) {
      c.skip(name, stage, Outcome::unsupported, lacking);
    } else if (exact) {
      judge_by_referee(c, theirs.records, stage, name);
    } else {
      judge_beside(c, theirs, of, stage, name);
    }
  }
}

}  // namespace plumbline::check

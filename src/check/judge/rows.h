// The kinds of rows of a scene's judgement, each by a function of its own (Kind, verdict.h), which appends a row for
// each stage that it judges.
#pragma once

#include "capture/capture.h"
#include "capture/renderer.h"
#include "check/judge/scene_judgement.h"

namespace plumbline::check {

/// Rows of a reference that draws the scene itself, `theirs`: Kind::side_by_side, Kind::legal where it hands out legal
/// answers, or, of the referee, Kind::from_scene. `of`: the reference's info; `candidate`: the candidate's.
void judge_from_scene(const SceneJudgement& c, const Capture& theirs, const RendererInfo& of,
                      const RendererInfo& candidate);

/// The stage that the reference shows, beside the candidate's.
void side_by_side(const SceneJudgement& c, const Capture& theirs, Stage stage, const JudgeId& name);

/// Coverage, depth, colour or visibility against an oracle's legal answers.
void ask_oracle(const SceneJudgement& c, const Legal& legal, Stage stage, const JudgeId& name);

/// Row per_stage: the referee runs the stage on the candidate's records, and the results are compared.
void run_exact_stage(const SceneJudgement& c, Renderer& referee, Stage stage, const JudgeId& name);

/// The stage as it was made of the candidate's own records, against the candidate's. Not of matrices, nor of resolve.
void compare_stage(const SceneJudgement& c, const Capture& made, Stage stage, const JudgeId& name);

}  // namespace plumbline::check

// Functions that append rows to a scene's judgement, one function per kind of row (Kind, verdict.h).
#pragma once

#include "capture/capture.h"
#include "capture/renderer.h"
#include "check/judge/scene_judgement.h"

namespace plumbline::check {

/// Rows of a reference that draws the scene itself, `theirs`: Kind::side_by_side, Kind::legal where it hands out legal
/// answers, or, of the referee, Kind::from_scene. `of`: the reference's info; `candidate`: the candidate's.
void judge_from_scene(const SceneJudgement& c, const Capture& theirs, const RendererInfo& of,
                      const RendererInfo& candidate);

/// Appends the row of one stage that compares the reference's planes or records with the candidate's
/// (Kind::side_by_side).
void side_by_side(const SceneJudgement& c, const Capture& theirs, Stage stage, const JudgeId& name);

/// Appends the row that compares coverage, depth, colour or visibility with an oracle's legal answers (Kind::legal).
void compare_with_legal(const SceneJudgement& c, const Legal& legal, Stage stage, const JudgeId& name);

/// Appends the row `name` (Kind::per_stage, repaired or at_worst): the referee runs the stage on the candidate's
/// records, and compare_stage() compares the result.
void run_exact_stage(const SceneJudgement& c, Renderer& referee, Stage stage, const JudgeId& name);

/// Appends the row that compares the candidate's stage with `made`, the referee's stage of the candidate's records. No
/// row for matrices and resolve.
void compare_stage(const SceneJudgement& c, const Capture& made, Stage stage, const JudgeId& name);

}  // namespace plumbline::check

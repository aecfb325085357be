// Judging the candidate's own records, and its painters' frames.
#pragma once

#include <map>
#include <vector>

#include "capture/renderer.h"
#include "check/verdict/verdict.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Stages as a referee makes them of the candidate's own records.
using MadeStages = std::map<Stage, Capture>;

/// Rows of Kind::per_stage: every stage but matrices and resolve, as `referee` makes it of the candidate's own records,
/// against the candidate's. `shown`: the candidate's info, which gives its abilities, profile and conventions; null: it
/// shows every stage, is not foreign, and draws by OpenGL's conventions. `made`: stages that the referee has run
/// already. `legal`: answers that are no difference in a foreign candidate's coverage (Profile::foreign).
std::vector<Comparison> judge_records(const Scene& scene, const Capture& candidate, Renderer& referee,
                                      const RendererInfo* shown = nullptr, const MadeStages& made = {},
                                      const Legal& legal = {});

/// Each painter's frame, drawn without records, bit for bit against `watched`, the frame drawn with records: one row
/// `picture` of the last stage, of the first painter that differs.
Comparison judge_picture(const Scene& scene, Renderer& candidate, const Capture& watched);

}  // namespace plumbline::check

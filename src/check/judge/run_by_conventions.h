// Stages as a referee makes them of a renderer's own records, by the renderer's conventions.
#pragma once

#include "capture/conventions.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Whether run_by_conventions() knows which triangle owns a sample on an edge: the rule is settled (conventions.h,
/// settles_ties), by left or right and bottom or top; window.snapped holds the grid (at most 8 bits); pixels are sampled
/// at their centres.
bool knows_ties(const Scene& scene, const Conventions& conventions);

/// referee.run_stage(scene, stage, in), but for what the conventions say otherwise than OpenGL:
/// - coverage: where knows_ties(), triangles own samples on their edges by the declared rule;
/// - depth, attributes, texture: where no corner is snapped, triangles face as their unsnapped corners do, between which
///   the renderer interpolates; where attribute_corners are snapped, the renderer interpolates between snapped corners;
/// - visibility: where alpha tests are in float, alphas are not rounded to codes.
/// Throws as run_stage() does.
Capture run_by_conventions(Renderer& referee, const Scene& scene, Stage stage, const Capture& in,
                           const Conventions& conventions);

}  // namespace plumbline::check

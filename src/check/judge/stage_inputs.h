// Inputs that judging a stage needs, and which of them a candidate lacks.
#pragma once

#include <string>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Stages whose records are the stage's input or enter its tolerance.
StageSet inputs_of(Stage stage);

/// Whether `planes` holds the plane that an oracle's legal answers of the stage are compared with.
bool has_plane(const Planes& planes, Stage stage);

/// Why a stage cannot be compared side by side, or with the referee's from the scene; empty: it can. Counts and winners
/// have no tolerance and need planes alone; winners of lines and points also records of coverage and depth. Other
/// planes are compared where both sides' winners agree, within bounds computed from the records of earlier stages.
std::string lacking_beside(const Scene& scene, const Planes& planes, const RendererInfo& candidate, Stage stage);

/// Why a stage cannot be compared with the referee's of the candidate's own records; empty: it can. Of coverage,
/// visibility and merge themselves planes suffice; of a stage's inputs records are needed.
std::string lacking_per_stage(const Scene& scene, const RendererInfo& candidate, Stage stage);

}  // namespace plumbline::check

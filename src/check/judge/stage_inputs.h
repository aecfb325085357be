// Inputs that a stage is judged by, and which of them a candidate lacks.
#pragma once

#include <string>

#include "capture/capture.h"
#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Stages whose records a stage is made of, and its tolerance computed from.
StageSet inputs_of(Stage stage);

/// Whether the plane is there that an oracle's answers of the stage are compared with.
bool has_plane(const Planes& planes, Stage stage);

/// Why a stage cannot be compared side by side, or with the referee's from the scene; empty: it can. Counts and winners
/// are compared without a tolerance. Other planes are compared where both sides' winners agree, within bounds that are
/// computed from the records of all stages before.
std::string lacking_beside(const Scene& scene, const Planes& planes, const RendererInfo& candidate, Stage stage);

/// Why a stage cannot be compared with the referee's of the candidate's own records; empty: it can. Planes suffice of
/// coverage, visibility and merge.
std::string lacking_per_stage(const Scene& scene, const RendererInfo& candidate, Stage stage);

}  // namespace plumbline::check

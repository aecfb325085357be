// Faults of renderers that ignore a state of the scene: each is drawn as the scene with that state at its default.
#pragma once

#include <vector>

#include "cli/likely/known_fault.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// One fault for each state that the scene sets, "STAGE.STATE_ignored".
std::vector<KnownFault> ignored_states(const Scene& scene);

}  // namespace plumbline::cli

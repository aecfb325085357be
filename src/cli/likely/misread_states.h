// Faults of renderers that ignore a state of the scene, or take it for another: each is drawn as the scene so changed.
#pragma once

#include <vector>

#include "cli/likely/known_fault.h"
#include "scene/scene.h"

namespace plumbline::cli {

/// One fault for each state of the table: "STAGE.STATE_ignored" where a scene is drawn with the state's default.
std::vector<KnownFault> misread_states();
/// Faults of misread_states() that change the scene. The stage of a state that the light equation reads is shade where
/// fragments are lit, and no vertices.
std::vector<KnownFault> misread_states(const Scene& scene);

}  // namespace plumbline::cli

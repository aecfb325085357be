// Parser of a draw's fragment state in scene files: scissor, tests, polygon offset, blending, masks.
#pragma once

#include "scene/json/json_tree.h"
#include "scene/scene.h"

namespace plumbline {

/// Overwrites the draw's fragment state of every key in the node. Throws JsonError.
void read_fragment_state(const JsonNode& node, Draw& draw);

}  // namespace plumbline

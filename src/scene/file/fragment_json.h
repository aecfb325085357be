// What a draw of a scene file says of its fragments: tests, blending, masks.
#pragma once

#include "scene/json/json_tree.h"
#include "scene/scene.h"

namespace plumbline {

/// What the node gives, over what the draw has. Throws JsonError.
void read_fragment_state(const JsonNode& node, Draw& draw);

}  // namespace plumbline

// The "draws" of a scene file, and their "defaults".
#pragma once

#include <vector>

#include "scene/json/json_tree.h"
#include "scene/scene.h"

namespace plumbline {

/// A draw's state, without its mesh.
struct DrawState {
  Draw draw;
  bool has_material = false;  ///< the file gives one; a mesh file's own counts where not
};

/// What "defaults" holds, over the dialect's: any key of a draw but its mesh. `textures`: the scene's. Throws
/// JsonError.
DrawState read_draw_state(const JsonNode& node, const DrawState& defaults, const std::vector<Texture>& textures);

/// A draw: its keys over the defaults'; of a material, each key for itself. Throws JsonError.
DrawState read_draw(const JsonNode& node, const DrawState& defaults, const std::vector<Texture>& textures);

}  // namespace plumbline

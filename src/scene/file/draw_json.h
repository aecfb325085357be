// The "draws" of a scene file, and their "defaults".
#pragma once

#include <vector>

#include "scene/json/json_tree.h"
#include "scene/scene.h"

namespace plumbline {

/// A draw's state, without its mesh.
struct DrawState {
  Draw draw;
  bool has_material = false;  ///< the scene file gives a material; false: that of the mesh file, if any, is used
};

/// Reads "defaults": any key of a draw but "mesh". Keys that are left out keep the values of `defaults`, the dialect's.
/// `textures`: the scene's. Throws JsonError.
DrawState read_draw_state(const JsonNode& node, const DrawState& defaults, const std::vector<Texture>& textures);

/// Reads a draw's state. Omitted keys keep the values of `defaults`, as do omitted keys within material, back_material
/// and texture; any other value is replaced as a whole. The mesh is left to read_mesh(). Throws JsonError.
DrawState read_draw(const JsonNode& node, const DrawState& defaults, const std::vector<Texture>& textures);

}  // namespace plumbline

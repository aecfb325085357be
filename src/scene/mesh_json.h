// The "mesh" of a scene file's draw.
#pragma once

#include <filesystem>
#include <span>

#include "scene/json_tree.h"
#include "scene/scene.h"

namespace plumbline {

/// Makes or loads the mesh that the node describes (scene_file.h); files are looked for in `folders`, in order.
/// Throws JsonError.
Mesh read_mesh(const JsonNode& node, std::span<const std::filesystem::path> folders);

}  // namespace plumbline

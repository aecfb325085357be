// The "mesh" of a scene file's draw.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/json/json_tree.h"
#include "scene/mesh/mesh_file.h"

namespace plumbline {

/// Makes or loads the mesh that the node describes (scene.schema.json): one part; for a mesh file, one part per run of
/// triangles of one material. More than `most_triangles` are refused: before a generator runs, while a mesh file is
/// read; meshes written out in the scene file are not checked. Throws JsonError.
std::vector<MeshPart> read_mesh(const JsonNode& node, const AssetFolders& folders, std::size_t most_triangles);

}  // namespace plumbline

// Mesh files through assimp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/mesh/mesh_part.h"

namespace plumbline {

/// load_mesh() (mesh_file.h) in this process: assimp may crash or hang it. Throws std::runtime_error: expected ...,
/// found ...
std::vector<MeshPart> import_mesh(const std::filesystem::path& file, const AssetFolders& folders,
                                  std::size_t most_triangles);

}  // namespace plumbline

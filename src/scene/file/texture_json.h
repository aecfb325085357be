// The "textures" of a scene file, and a draw's "texture".
#pragma once

#include <optional>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/json/json_tree.h"
#include "scene/texture.h"

namespace plumbline {

/// In the order of their names, at most 64. Throws JsonError.
std::vector<Texture> read_textures(const JsonNode& node, const AssetFolders& folders);

/// A draw's texture, one of the scene's: each key over that of the draws' default, if there is one. Throws JsonError:
/// an unknown name, decal on a texture that is neither rgb nor rgba (OpenGL leaves that undefined).
DrawTexture read_draw_texture(const JsonNode& node, const std::vector<Texture>& textures,
                              const std::optional<DrawTexture>& of_all);

}  // namespace plumbline

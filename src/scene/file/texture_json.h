// The "textures" of a scene file, and a draw's "texture".
#pragma once

#include <optional>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/json/json_tree.h"
#include "scene/texture.h"

namespace plumbline {

/// The scene's textures in the order of their names, at most 64, with all levels made. Throws JsonError.
std::vector<Texture> read_textures(const JsonNode& node, const AssetFolders& folders);

/// A draw's texture, one of `textures`. Keys that are left out keep the values of `of_all`, the draws' default, if
/// there is one. Throws JsonError: an unknown name, decal on a texture that is neither rgb nor rgba (undefined in
/// OpenGL).
DrawTexture read_draw_texture(const JsonNode& node, const std::vector<Texture>& textures,
                              const std::optional<DrawTexture>& of_all);

}  // namespace plumbline

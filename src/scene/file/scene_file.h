// Scenes from JSON files.
#pragma once

#include <filesystem>
#include <span>
#include <stdexcept>
#include <vector>

#include "scene/scene.h"

namespace plumbline {

/// The message is: file: at "JSON pointer": expected ..., found ...
struct SceneError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SceneFileOptions {
  /// Folders in which mesh, image and included files are looked for, after the scene's own; default: set by the build.
  std::vector<std::filesystem::path> asset_folders = {PLUMBLINE_ASSETS};
};

/// Reads a scene: one JSON object (comments allowed), in the format of tests/scenes/scene.schema.json. A key that is
/// left out has its default there; any other key is an error. Numbers that scene.h holds as float are rounded here,
/// once. Draws of an equal mesh share it.
///
/// A file is a patch of the files that it includes (RFC 7396, JSON merge patch; scene_json.h). Mesh files, image files
/// and included files are looked for in the scene's folder, then in the asset folders, and below these: no link and no
/// ".." may lead out of them.
///
/// The scene's name is "folder/file", without the ending. Throws SceneError.
Scene load_scene(const std::filesystem::path& file, const SceneFileOptions& options = {});

/// The scene files that `paths` name: files as they are; of folders all *.json in them and below, sorted, but for
/// *.part.json (what scenes include), *.schema.json and *.rubric.json.
/// Throws SceneError if a path does not exist, or nothing is found.
std::vector<std::filesystem::path> find_scenes(std::span<const std::filesystem::path> paths);

}  // namespace plumbline

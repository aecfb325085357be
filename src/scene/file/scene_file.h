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
  /// Folders in which mesh, image and included files are searched, after the scene's own; default: set by the build.
  std::vector<std::filesystem::path> asset_folders = {PLUMBLINE_ASSETS};
};

/// Reads a scene: one JSON object (comments allowed), in the format of tests/scenes/scene.schema.json, which gives the
/// defaults of keys that are left out; an unknown key is an error. Numbers that scene.h holds as float are rounded
/// here, once. Draws whose "mesh" values are equal share a mesh.
///
/// A file is a patch of the files that it includes (RFC 7396, JSON merge patch; scene_json.h). Mesh files, image files
/// and included files are searched in the scene's folder, then in the asset folders, and below; no link and no ".."
/// may lead out of these.
///
/// Scene::name is "folder/file", without the ending. Throws SceneError.
Scene load_scene(const std::filesystem::path& file, const SceneFileOptions& options = {});

/// Scene files of `paths`, in the order of `paths`: a file as it is; of a folder all *.json in it and below, sorted.
/// Left out: *.part.json (files that scenes include), *.schema.json and *.rubric.json, unless `paths` are such alone.
/// Throws SceneError if a path does not exist or names no scene, or if `paths` is empty.
std::vector<std::filesystem::path> find_scenes(std::span<const std::filesystem::path> paths);

}  // namespace plumbline

// The suite's scenes, tests/scenes: their files, one by its name, and all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/file/scene_file.h"

namespace plumbline {

inline std::filesystem::path suite_folder() { return PLUMBLINE_SOURCE_DIR "/tests/scenes"; }

/// In the order of their names.
inline std::vector<std::filesystem::path> suite_files() {
  const std::filesystem::path folder[] = {suite_folder()};
  return find_scenes(folder);
}

/// GROUP/NAME.
inline Scene suite_scene(const std::string& name) { return load_scene(suite_folder() / (name + ".json"), {}); }

/// All but the big models, read once.
inline const std::vector<Scene>& suite_scenes() {
  static const std::vector<Scene> kAll = [] {
    std::vector<Scene> out;
    for (const auto& file : suite_files()) {
      if (file.parent_path().stem() != "models") out.push_back(load_scene(file, {}));
    }
    return out;
  }();
  return kAll;
}

}  // namespace plumbline

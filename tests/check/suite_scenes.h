// The suite's scenes: one by its name, and all.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/file/scene_file.h"

namespace plumbline {

/// GROUP/NAME.
inline Scene suite_scene(const std::string& name) {
  return load_scene(std::filesystem::path(PLUMBLINE_SOURCE_DIR "/tests/scenes") / (name + ".json"), {});
}

/// All but the big models, read once.
inline const std::vector<Scene>& suite_scenes() {
  static const std::vector<Scene> kAll = [] {
    const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
    std::vector<Scene> out;
    for (const auto& file : find_scenes(folder)) {
      if (file.parent_path().stem() != "models") out.push_back(load_scene(file, {}));
    }
    return out;
  }();
  return kAll;
}

}  // namespace plumbline

// The suite's scenes, for tests that go through them all.
#pragma once

#include <vector>

#include "scene/scene_file.h"

namespace plumbline {

/// All but the big models, read once.
inline const std::vector<Scene>& suite_scenes() {
  static const std::vector<Scene> kScenes = [] {
    const std::filesystem::path folder[] = {PLUMBLINE_SOURCE_DIR "/tests/scenes"};
    std::vector<Scene> out;
    for (const auto& file : find_scenes(folder)) {
      if (file.parent_path().stem() != "models") out.push_back(load_scene(file, {}));
    }
    return out;
  }();
  return kScenes;
}

}  // namespace plumbline

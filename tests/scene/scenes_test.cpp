// The suite's scenes: all can be read, and between them they have every state.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "scene/file/scene_file.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

TEST(Scenes, AllLoadAndEveryStateOccurs) {
  std::set<std::string> names, states;
  for (const std::filesystem::path& file : suite_files()) {
    const Scene s = load_scene(file);
    EXPECT_TRUE(names.insert(s.name).second) << s.name;
    const auto seen = [&](const char* what, auto value) {
      states.insert(what + std::to_string(static_cast<int>(value)));
    };
    seen("color ", s.frame.color);
    seen("depth ", s.frame.depth);
    seen("projection ", s.projection.index());
    seen("dialect ", s.dialect);
    seen("antialias ", s.frame.antialias.kind);
    for (const Light& light : s.lights) seen("light ", light.kind);
    for (const Draw& draw : s.draws) {
      seen("lit ", draw.lit);
      seen("color_material ", draw.color_material);
      seen("normals ", draw.normals);
      seen("shading ", draw.shading);
      seen("cull ", draw.cull);
      seen("func ", draw.depth_func);
      for (const Transform& transform : draw.transforms) seen("transform ", transform.index());
    }
  }
  EXPECT_EQ(states.size(), 4u + 4 + 5 + 4 + 4 + 2 + 2 + 6 + 3 + 3 + 3 + 8 + 3);
}

}  // namespace
}  // namespace plumbline

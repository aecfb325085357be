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

// The kit's README promises what these scenes ask for.
TEST(Scenes, FirstTrianglesAskForOneColourADrawAlone) {
  std::size_t count = 0;
  for (const std::filesystem::path& file : suite_files()) {
    if (file.parent_path().stem() != "first_triangles") continue;
    const Scene scene = load_scene(file);
    ++count;
    EXPECT_EQ(scene.frame.color, ColorFormat::rgba8) << file;
    EXPECT_TRUE(scene.textures.empty()) << file;
    for (const Mesh& mesh : scene.meshes) EXPECT_TRUE(mesh.colors.empty()) << file;
    for (const Draw& draw : scene.draws) {
      EXPECT_FALSE(draw.lit) << file;
      EXPECT_EQ(draw.depth_func, DepthFunc::always) << file;
      EXPECT_FALSE(draw.fog || draw.alpha_test || draw.stencil || draw.scissor) << file;
      EXPECT_EQ(draw.material.diffuse.a, 1) << file;
    }
  }
  EXPECT_EQ(count, 22u);
}

}  // namespace
}  // namespace plumbline

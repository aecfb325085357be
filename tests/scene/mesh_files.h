// Mesh files that a test writes and reads.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "scene/json/scene_values.h"
#include "scene/mesh/mesh_file.h"

#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {

inline std::vector<MeshPart> load_parts(const std::filesystem::path& file) {
  return load_mesh(file, AssetFolders({file.parent_path()}), kMostPrimitives);
}
/// Reads a file that must come to one part: of one material at most.
inline Mesh load_one(const std::filesystem::path& file) {
  std::vector<MeshPart> parts = load_parts(file);
  EXPECT_EQ(parts.size(), 1u);
  return std::move(parts.front().mesh);
}

class MeshFile : public TestFolder {
 protected:
  std::filesystem::path write(const std::string& text, const std::string& name = "mesh.obj") const {
    test::write_text(root_ / name, text);
    return root_ / name;
  }
  Mesh load(const std::string& text) const { return load_one(write(text)); }
  void refused(const std::filesystem::path& file, const std::string& expected) const {
    try {
      load_parts(file);
      ADD_FAILURE() << "not refused: " << file;
    } catch (const MeshError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find(file.string() + ": "), 0u) << what;
      EXPECT_NE(what.find(expected), what.npos) << what;
    }
  }
};

}  // namespace plumbline

// Mesh files: what comes in, what is repaired, what is refused.
#include "scene/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>

namespace plumbline {
namespace {

namespace fs = std::filesystem;

class MeshFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(testing::TempDir()) / (std::string("plumbline_mesh_file_") + info->name());
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path write(const std::string& text, const std::string& name = "mesh.obj") const {
    std::ofstream(root_ / name, std::ios::binary) << text;
    return root_ / name;
  }
  Mesh load(const std::string& text) const { return load_mesh(write(text)); }
  void refused(const fs::path& file, const std::string& expected) const {
    try {
      load_mesh(file);
      ADD_FAILURE() << "not refused: " << file;
    } catch (const MeshError& error) {
      const std::string what = error.what();
      EXPECT_EQ(what.find(file.string() + ": "), 0u) << what;
      EXPECT_NE(what.find(expected), what.npos) << what;
    }
  }

  fs::path root_;
};

TEST_F(MeshFile, ReadsPolygonsWithTheirWinding) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  EXPECT_TRUE(mesh.colors.empty());
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 n =
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    EXPECT_EQ(n, glm::vec3(0, 0, 1));
  }
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST_F(MeshFile, KeepsNormalsAtUnitLengthAndReplacesBadOnes) {
  const Mesh mesh = load(
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 6 5 5\nv 5 6 5\nvn 0 3 4\nvn 0 0 0\nvn nan 0 0\n"
      "f 1//1 2//2 3//3\n");
  ASSERT_EQ(mesh.positions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const bool given = mesh.positions[i] == glm::vec3(0);
    const glm::vec3 expected = given ? glm::vec3(0, 0.6f, 0.8f) : glm::vec3(0, 0, 1);
    for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(mesh.normals[i][k], expected[k]) << i;
  }
}

TEST_F(MeshFile, DropsPointsLinesAndDegenerateTriangles) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 2 2\np 1\nl 1 2\nf 1 2 2\nf 1 2 3\n");
  ASSERT_EQ(mesh.triangles.size(), 1u);
  refused(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\n"), "expected triangles");
}

TEST_F(MeshFile, Refuses) {
  refused(write(""), "expected");
  refused(write("v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "expected");
  refused(write("not a mesh at all"), "expected");
  refused(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "expected");
  refused(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -9\n"), "expected");
  refused(write("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), "expected coordinates");
  refused(write("v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n"), "expected coordinates");
  refused(write("v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n"), "expected coordinates");
  refused(write("v 0 0 0\n", "mesh.ply"), "ending in .obj or .3ds");
  refused(write("MMMM", "mesh.3ds"), "expected");
  refused(root_ / "none.obj", "expected a mesh file, found none");
}

/// A 3DS chunk: its number, its length with this head, and what is in it.
std::string chunk(std::uint16_t id, const std::string& data) {
  const auto size = static_cast<std::uint32_t>(data.size() + 6);
  std::string bytes(6, '\0');
  std::memcpy(bytes.data(), &id, 2);
  std::memcpy(bytes.data() + 2, &size, 4);
  return bytes + data;
}
template <class T>
std::string bytes_of(std::initializer_list<T> values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), std::data(values), bytes.size());
  return bytes;
}

/// A tetrahedron whose node is scaled by -1 along x: inside out if placed without turning its triangles.
TEST_F(MeshFile, MirroredPartsStayRightSideOut) {
  using namespace std::string_literals;
  const std::string vertices = bytes_of<std::uint16_t>({4}) + bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  const std::string faces =
      bytes_of<std::uint16_t>({4, 0, 2, 1, 7, 0, 1, 3, 7, 0, 3, 2, 7, 1, 2, 3, 7});  // three corners and flags each
  const std::string matrix = bytes_of<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  const std::string mesh = chunk(0x4100, chunk(0x4110, vertices) + chunk(0x4160, matrix) + chunk(0x4120, faces));
  const std::string scale_track = bytes_of<std::uint16_t>({0, 0, 0, 0, 0, 1, 0, 0, 0, 0}) + bytes_of<float>({-1, 1, 1});
  const std::string node = chunk(0xB030, bytes_of<std::uint16_t>({0})) +
                           chunk(0xB010, "part\0"s + bytes_of<std::uint16_t>({0, 0, 0xffff})) +
                           chunk(0xB022, scale_track);
  const std::string file =
      chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, "part\0"s + mesh)) + chunk(0xB000, chunk(0xB002, node)));
  const Mesh placed = load_mesh(write(file, "mesh.3ds"));
  ASSERT_EQ(placed.triangles.size(), 4u);
  double volume = 0, least_x = 0;
  for (const glm::uvec3& t : placed.triangles) {
    const glm::dvec3 a(placed.positions[t.x]), b(placed.positions[t.y]), c(placed.positions[t.z]);
    const glm::dvec3 n(placed.normals[t.x] + placed.normals[t.y] + placed.normals[t.z]);
    EXPECT_GT(glm::dot(glm::cross(b - a, c - a), n), 0);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
    least_x = std::min({least_x, a.x, b.x, c.x});
  }
  EXPECT_NEAR(volume, 1.0 / 6, 1e-6);
  EXPECT_EQ(least_x, -1);  // it is mirrored
}

// The models that the scenes use. Signed volume > 0: counter-clockwise from outside. That most normals go with their
// triangles: the two were not mirrored apart.
struct Model {
  const char* file;
  std::size_t triangles;
};
class Models : public testing::TestWithParam<Model> {};

TEST_P(Models, AreWholeAndFaceOutward) {
  const Mesh mesh = load_mesh(fs::path(PLUMBLINE_ASSETS) / GetParam().file);
  EXPECT_EQ(mesh.triangles.size(), GetParam().triangles);
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const glm::vec3& n : mesh.normals) EXPECT_NEAR(glm::length(n), 1, 1e-5);
  double volume = 0;
  std::size_t agree = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
    const glm::dvec3 n(mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z]);
    agree += glm::dot(glm::cross(b - a, c - a), n) >= 0;
  }
  EXPECT_GT(volume, 0.1);
  EXPECT_GT(static_cast<double>(agree), 0.99 * static_cast<double>(mesh.triangles.size()));
}
INSTANTIATE_TEST_SUITE_P(Glmark2, Models,
                         testing::Values(Model{"bunny.obj", 69666}, Model{"horse.3ds", 7172}, Model{"cat.3ds", 14348},
                                         Model{"asteroid-high.3ds", 48000}),
                         [](const auto& model) {
                           const std::string file = model.param.file;
                           return file.substr(0, file.find_first_of("-."));
                         });

}  // namespace
}  // namespace plumbline

// Mesh files of any format: polygons, normals, limits, the models that scenes use.
#include "scene/mesh/mesh_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include <sys/stat.h>

#include "tests/scene/mesh_files.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

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

TEST_F(MeshFile, KeepsNormalsAtUnitLength) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nvn 0 0 2\nf 1//1 2//2 3//2\n");
  ASSERT_EQ(mesh.positions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 expected = mesh.positions[i] == glm::vec3(0) ? glm::vec3(0, 0.6f, 0.8f) : glm::vec3(0, 0, 1);
    for (int k = 0; k < 3; ++k) EXPECT_FLOAT_EQ(mesh.normals[i][k], expected[k]) << i;
  }
}

TEST_F(MeshFile, MakesNormalsWhereATriangleHasNoArea) {
  const Mesh mesh = load("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST_F(MeshFile, LeavesOutTrianglesThatHaveAVertexTwice) {
  EXPECT_EQ(load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 2\nf 1 2 3\n").triangles.size(), 1u);
}

TEST_F(MeshFile, CutsAConcavePolygonWithinItsOutline) {
  const Mesh mesh = load("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    EXPECT_GT(glm::cross(b - a, c - a).z, 0);
    area += glm::cross(b - a, c - a).z / 2;
  }
  EXPECT_FLOAT_EQ(static_cast<float>(area), 10);
}

TEST_F(MeshFile, RefusesPolygonsThatAreNotFlatOrCrossThemselves) {
  const std::string f = "f 1 2 3 4\n";
  refused(write("v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\n" + f), "a polygon that is not flat: corner ");
  refused(write("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 2 0\n" + f), "a polygon that crosses or touches itself");
  refused(write("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n" + f), "a polygon without an area");
  refused(write("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\n" + f), "a polygon without an area");
  refused(write("v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\n" + f), "a polygon that crosses or touches itself");
  refused(write("v 0 0 0\nv 2 0 0\nv 1 0 0\nv 0 1 0\n" + f), "a polygon that crosses or touches itself");
  for (const char* third : {"0.0001", "0.0068", "0.04"}) {  // 0.0068: corners are 0.12 % of the quad off its plane
    EXPECT_EQ(load("v 0 0 0\nv 1 0 0\nv 1 1 " + std::string(third) + "\nv 0 1 0\n" + f).triangles.size(), 2u);
  }
}

TEST_F(MeshFile, RefusesMoreTrianglesThanAllowed) {
  const fs::path file = write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
  EXPECT_NO_THROW(load_mesh(file, AssetFolders({root_}), 2));
  EXPECT_THROW(load_mesh(file, AssetFolders({root_}), 1), MeshError);
}

TEST_F(MeshFile, WaitsForNoPipe) {
  mkfifo((root_ / "pipe.mtl").c_str(), 0600);
  refused(write("mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "pipe.mtl");
}

TEST_F(MeshFile, RefusesAnotherFormatUnderTheEndingAtOnce) {
  refused(write("ply\nformat ascii 1.0\n", "mesh.glb"), "beginning with glTF");
  refused(write("ply\nformat ascii 1.0\n", "mesh.gltf"), "beginning with {");
  refused(write(" \n", "mesh.gltf"), "beginning with {");
  refused(write("glTF", "mesh.3ds"), "beginning with MM");
}

// Models that the scenes use. Signed volume > 0: counter-clockwise from outside. That most normals go with their
// triangles: the two were not mirrored apart.
struct Model {
  const char* file;
  std::size_t triangles;
};

class Models : public testing::TestWithParam<Model> {};

TEST_P(Models, AreWholeAndFaceOutward) {
  const Mesh mesh = load_one(fs::path(PLUMBLINE_ASSETS) / GetParam().file);
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

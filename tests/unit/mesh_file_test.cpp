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
#include <utility>
#include <vector>

#include <sys/stat.h>
#include "scene/scene_values.h"

#include "test_folder.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

std::vector<MeshPart> load_parts(const fs::path& file) {
  return load_mesh(file, AssetFolders({file.parent_path()}), kMostTriangles);
}
/// Of a file with one material at most.
Mesh load_one(const fs::path& file) {
  std::vector<MeshPart> parts = load_parts(file);
  EXPECT_EQ(parts.size(), 1u);
  return std::move(parts.front().mesh);
}

class MeshFile : public TestFolder {
 protected:
  fs::path write(const std::string& text, const std::string& name = "mesh.obj") const {
    std::ofstream(root_ / name, std::ios::binary) << text;
    return root_ / name;
  }
  Mesh load(const std::string& text) const { return load_one(write(text)); }
  void refused(const fs::path& file, const std::string& expected) const {
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

TEST_F(MeshFile, ReadsVertexColoursOfObj) {
  const Mesh mesh = load("v 0 0 0 1 0.5 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n");
  ASSERT_EQ(mesh.colors.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    if (mesh.positions[i] == glm::vec3(0)) {
      EXPECT_EQ(mesh.colors[i], glm::vec4(1, 0.5, 0, 1));
    }
  }
}

TEST_F(MeshFile, GivesEachMaterialOfAnObjItsPart) {
  write("newmtl red\nKa 0.1 0 0\nKd 1 0.5 0\nKs 0 0 1\nKe 0 0.2 0\nNs 250\nd 0.5\nnewmtl plain\nKd 0 1 0\nNs 7\n",
        "m.mtl");
  const std::vector<MeshPart> parts =
      load_parts(write("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                       "usemtl red\nf 1 2 3\nf 1 2 4\nusemtl plain\nf 3 2 1\n"));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].mesh.triangles.size(), 2u);
  EXPECT_EQ(parts[1].mesh.triangles.size(), 1u);
  ASSERT_TRUE(parts[0].material && parts[1].material);
  EXPECT_EQ(parts[0].material->ambient, glm::vec4(0.1f, 0, 0, 1));
  EXPECT_EQ(parts[0].material->diffuse, glm::vec4(1, 0.5f, 0, 0.5f));
  EXPECT_EQ(parts[0].material->specular, glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(parts[0].material->emission, glm::vec4(0, 0.2f, 0, 1));
  EXPECT_EQ(parts[0].material->shininess, 128);
  EXPECT_EQ(parts[1].material->diffuse, glm::vec4(0, 1, 0, 1));
  EXPECT_EQ(parts[1].material->shininess, 7);
  EXPECT_FALSE(load_parts(write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"))[0].material);
}

TEST_F(MeshFile, RefusesObj) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  refused(write(""), "expected");
  refused(write(triangle), "expected");
  refused(write("not a mesh at all"), "found \"not\" in line 1");
  refused(write(triangle + "f 1 2 9\n"), "expected an index of the 3 v that there are, found 9 in line 4");
  refused(write(triangle + "f 1 2 -9\n"), "expected");
  refused(write(triangle + "f 1 2 0\n"), "expected an index of the 3 v that there are, found 0 in line 4");
  refused(write("v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), "expected coordinates that are finite, found nan");
  refused(write("v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n"), "expected coordinates that are finite, found inf");
  refused(write("v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n"), "expected coordinates from -1000000 to 1000000, found");
  refused(write(triangle + "v 1 2\nf 1 2 3\n"), "expected v with 3, 4 or 6 numbers, found 2 in line 4");
  refused(write(triangle + "v 1 2 3 1 0 0\nf 1 2 3\n"), "expected v with 3 numbers as in the lines before, found 6");
  refused(write(triangle + "v 1 2 .5\nf 1 2 4\n"), "begins with a sign or a digit, found \".5\" in line 4");
  refused(write(triangle + "f 1 2 x\n"), "expected a corner such as 1, 1/2, 1//3 or 1/2/3, found \"x\" in line 4");
  refused(write(triangle + "f 1 2\n"), "expected a face of three corners or more, found 2 in line 4");
  refused(write(triangle + "l 1 2\nf 1 2 3\n"), "found \"l\" in line 4");
  refused(write(triangle + "vn 0 0 0\nf 1//1 2//1 3//1\n"),
          "expected finite normals that are not zero, for all corners or for none");
  refused(write(triangle + "vn nan 0 0\nf 1//1 2//1 3//1\n"),
          "expected finite normals that are not zero, for all corners or for none");
  refused(write("v 0 0 0 9 0 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n"), "expected colours from 0 to 1, found 9");
  refused(root_ / "none.obj", "expected a mesh file, found none");
  fs::resize_file(write("", "huge.obj"), 300u << 20);
  refused(root_ / "huge.obj", "expected a mesh file of at most 268435456 bytes, found 314572800");
  refused(write(triangle, "mesh.stl"), "ending in .obj, .3ds, .ply, .gltf or .glb");
}

TEST_F(MeshFile, RefusesPolygonsThatAreNotFlatOrCrossThemselves) {
  const std::string f = "f 1 2 3 4\n";
  refused(write("v 0 0 0\nv 1 0 0\nv 1 1 0.1\nv 0 1 0\n" + f), "a polygon that is not flat: corner ");
  refused(write("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 2 0\n" + f), "a polygon that crosses or touches itself");
  refused(write("v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\n" + f), "a polygon without an area");
  refused(write("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\n" + f), "a polygon without an area");
  refused(write("v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 1 0\n" + f), "a polygon that crosses or touches itself");
  refused(write("v 0 0 0\nv 2 0 0\nv 1 0 0\nv 0 1 0\n" + f), "a polygon that crosses or touches itself");
  EXPECT_EQ(load("v 0 0 0\nv 1 0 0\nv 1 1 0.0001\nv 0 1 0\n" + f).triangles.size(), 2u);
}

TEST_F(MeshFile, RefusesOtherFilesThatAreMissingOrElsewhere) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  refused(write("mtllib none.mtl\n" + triangle), "none.mtl\", which is no file");
  fs::create_directories(root_ / "inner");
  write("newmtl red\nKd 1 0 0\n", "outside.mtl");
  refused(write("mtllib ../outside.mtl\n" + triangle, "inner/mesh.obj"), "outside.mtl\", which is elsewhere");
  write("newmtl red\nKd 2 0 0\n", "bright.mtl");
  refused(write("mtllib bright.mtl\nusemtl red\n" + triangle),
          "expected colours from 0 to 1, found 2 in the material red");
}

std::string ply(const std::string& vertices, const std::string& faces, int vertex_count = 3, int face_count = 1) {
  return "ply\nformat ascii 1.0\ncomment c\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}
const std::string kPlyVertices = "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 51\n";

TEST_F(MeshFile, ReadsPlyWithColours) {
  const Mesh mesh = load_one(write(ply(kPlyVertices, "3 0 1 2\n"), "mesh.ply"));
  EXPECT_EQ(mesh.triangles.size(), 1u);
  ASSERT_EQ(mesh.colors.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    if (mesh.positions[i] == glm::vec3(0, 1, 0)) {
      EXPECT_EQ(mesh.colors[i], glm::vec4(0, 0, 0.2f, 1));
    }
  }
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

TEST_F(MeshFile, ReadsBinaryPlyOfBothByteOrders) {
  for (const bool big : {false, true}) {
    std::string body;
    const auto put = [&](auto value) {
      std::string bytes(sizeof value, '\0');
      std::memcpy(bytes.data(), &value, sizeof value);
      if (big) std::reverse(bytes.begin(), bytes.end());
      body += bytes;
    };
    for (const int x : {0, 0, 0, 1, 0, 0, 0, 1, 0}) put(static_cast<float>(x));
    put(std::uint8_t{3});
    for (const std::int32_t i : {0, 1, 2}) put(i);
    const std::string header = std::string("ply\nformat ") + (big ? "binary_big_endian" : "binary_little_endian") +
                               " 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                               "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_EQ(load_one(write(header + body, "mesh.ply")).triangles.size(), 1u);
    refused(write(header + body.substr(0, body.size() - 1), "mesh.ply"), "found 0: a truncated file");
    refused(write(header + body + "x", "mesh.ply"), "expected the file's end after its last element, found 1 bytes");
    body[36] = 2;
    refused(write(header + body, "mesh.ply"), "expected faces of three corners or more, found 2 in face 0");
  }
}

TEST_F(MeshFile, RefusesPly) {
  const auto refuse = [&](const std::string& text, const std::string& expected) {
    refused(write(text, "mesh.ply"), expected);
  };
  refuse("", "begins with the line \"ply\"");
  refuse("ply\nformat ascii 1.0\n", "expected end_header");
  refuse("ply\nend_header\n", "expected a PLY header that tells the format");
  refuse("ply\nformat text 1.0\nend_header\n", "expected a PLY format");
  refuse("ply\nformat ascii 1.0\nelement vertex -3\nend_header\n", "expected an element's count");
  refuse("ply\nformat ascii 1.0\nelement vertex 3\nproperty real x\nend_header\n", "\"real\" in the header");
  refuse("ply\nformat ascii 1.0\nelement vertex 4000000000\nend_header\n", "expected vertices with x, y and z");
  refuse("ply\nformat ascii 1.0\nelement face 1\nproperty list float int vertex_indices\nend_header\n",
         "expected an integer type of PLY, found \"float\"");
  refuse(ply(kPlyVertices, "3 0 1 2\n", 4), "expected a number for green, found \"\" in vertex 3 of 4");
  refuse(ply(kPlyVertices, "3 0 1 2\n", 2'000'000'000), "found \"\" in vertex 3 of 2000000000");
  refuse(ply(kPlyVertices, "3 0 1 2\n", 3, 2), "expected 2 of face, found 1: a truncated file");
  refuse(ply(kPlyVertices, "3 0 1\n"), "expected a number for vertex_indices, found \"\" in face 0 of 1");
  refuse(ply(kPlyVertices, "3 0 1 2 3\n"), "expected the line's end, found \"3\" in face 0 of 1");
  refuse(ply(kPlyVertices, "3 0 1 7\n"), "expected vertices below 3, found 7 in face 0");
  refuse(ply(kPlyVertices, "3 0 1 -1\n"), "expected vertices below 3");
  refuse(ply(kPlyVertices, "2 0 1\n"), "expected faces of three corners or more, found 2 in face 0");
  refuse(ply(kPlyVertices, "4294967295 0 1\n"), "expected a number for vertex_indices");
  refuse(ply("nan 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n", "3 0 1 2\n"), "expected coordinates that are finite");
}

/// Three vertices with colours, moved and mirrored by their node.
std::string gltf(const std::string& indices = "AAABAAIA", int count = 3, const std::string& buffer_rest = "",
                 const std::string& scale = "-1, 1, 1") {
  // float positions (0,0,0) (1,0,0) (0,1,0); colours red, green, half blue; then 16-bit indices
  const std::string data =
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
      "AACAPwAAAAAAAAAAAACAPwAAAAAAAIA/AAAAAAAAgD8AAAAAAAAAAAAAgD8AAAA/" +
      indices;
  const std::string uri = buffer_rest.empty() ? "data:application/octet-stream;base64," + data : buffer_rest;
  const std::string size = std::to_string(2 * count);
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "translation": [1, 2, 3], "scale": [)" +
         scale + R"(]}],
    "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, 0.8]}, "emissiveFactor": [0.1, 0, 0]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "COLOR_0": 1}, "indices": 2, "material": 0}]}],
    "buffers": [{"byteLength": )" +
         std::to_string(84 + 2 * count) + R"(, "uri": ")" + uri + R"("}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 48},
                    {"buffer": 0, "byteOffset": 84, "byteLength": )" +
         size + R"(}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                  {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC4"},
                  {"bufferView": 2, "componentType": 5123, "count": )" +
         std::to_string(count) + R"(, "type": "SCALAR"}]})";
}

TEST_F(MeshFile, ReadsGltfWithNodesColoursAndBaseColour) {
  const std::vector<MeshPart> parts = load_parts(write(gltf(), "mesh.gltf"));
  ASSERT_EQ(parts.size(), 1u);
  const Mesh& mesh = parts[0].mesh;
  ASSERT_EQ(mesh.triangles.size(), 1u);
  const glm::uvec3 t = mesh.triangles[0];
  const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  EXPECT_GT(glm::cross(b - a, c - a).z, 0);  // mirrored, and turned with it
  ASSERT_EQ(mesh.colors.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    if (mesh.positions[i] == glm::vec3(0, 2, 3)) {
      EXPECT_EQ(mesh.colors[i], glm::vec4(0, 1, 0, 1));
    }
    if (mesh.positions[i] == glm::vec3(1, 3, 3)) {
      EXPECT_EQ(mesh.colors[i], glm::vec4(0, 0, 1, 0.5));
    }
  }
  ASSERT_TRUE(parts[0].material);
  EXPECT_EQ(parts[0].material->diffuse, glm::vec4(0.2f, 0.4f, 0.6f, 0.8f));
  EXPECT_EQ(parts[0].material->ambient, glm::vec4(0.2f, 0.4f, 0.6f, 1));
  EXPECT_EQ(parts[0].material->emission, glm::vec4(0.1f, 0, 0, 1));
  EXPECT_EQ(parts[0].material->specular, glm::vec4(0, 0, 0, 1));
}

TEST_F(MeshFile, RefusesGltf) {
  const auto refuse = [&](const std::string& text, const std::string& expected) {
    refused(write(text, "mesh.gltf"), expected);
  };
  refuse("", "beginning with {");
  refuse("{}", "expected a mesh, found");
  refuse(gltf("AAABAAkA"), "expected a mesh, found Mesh \"meshes[0]\" has no faces");
  refuse(gltf("AAABAAIAAAABAAkA", 6), "out-of-range indices");  // one good triangle, one bad
  refuse(gltf("", 3), "expected 90 bytes, but found");
  refuse(gltf("", 3, "none.bin"), "none.bin\", which is no file");
  refuse(gltf("AAABAAIA", 3, "", "1e30, 1, 1"), "expected coordinates from -1000000 to 1000000");
  fs::create_directories(root_ / "inner");
  write("outside", "outside.bin");
  refused(write(gltf("", 3, "../outside.bin"), "inner/mesh.gltf"), "outside.bin\", which is elsewhere");
  refused(write("glTF", "mesh.glb"), "expected a mesh");
  refused(write(std::string("glTF\2\0\0\0\xff\xff\0\0", 12), "mesh.glb"), "expected a mesh");
}

TEST_F(MeshFile, RefusesMoreTrianglesThanAllowed) {
  const fs::path file = write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
  EXPECT_NO_THROW(load_mesh(file, AssetFolders({root_}), 2));
  EXPECT_THROW(load_mesh(file, AssetFolders({root_}), 1), MeshError);
}

TEST_F(MeshFile, RefusesIndicesOfWhatIsNotThere) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
  EXPECT_NO_THROW(load_parts(write(corners + "f 1/1/1 2/1/1 3/-1/-1\n")));
  EXPECT_NO_THROW(load_parts(write("f 1 2 3\n" + corners)));
  refused(write(corners + "f 1 2 4\n"), "expected an index of the 3 v that there are, found 4 in line 6");
  refused(write(corners + "f 1 2 -4\n"), "of the 3 v that there are, found -4");
  refused(write("f -1 -2 -3\n" + corners), "found -1 in line 1");
  refused(write(corners + "f 1 2 0\n"), "found 0");
  refused(write(corners + "f 1//2 2//1 3//1\n"), "expected an index of the 1 vn that there are, found 2");
  refused(write(corners + "f 1/9 2/1 3/1\n"), "expected an index of the 1 vt that there are, found 9");
  refused(write(corners + "f 1 2 99999999999999999999\n"), "found 99999999999999999999");
  refused(write("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n",
                "mesh.ply"),
          "expected vertices with x, y and z in the PLY header, found no z");
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

TEST_F(MeshFile, Refuses3ds) {
  refused(write("MMMM", "mesh.3ds"), "expected");
  std::ifstream in(fs::path(PLUMBLINE_ASSETS) / "cube.3ds", std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  ASSERT_GT(whole.size(), 600u);
  EXPECT_NO_THROW(load_parts(write(whole, "mesh.3ds")));
  for (std::size_t size = 29; size < whole.size(); size += 29) {
    refused(write(whole.substr(0, size), "mesh.3ds"), "expected a mesh");
  }
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
  const Mesh placed = load_one(write(file, "mesh.3ds"));
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

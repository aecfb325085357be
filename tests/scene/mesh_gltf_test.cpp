// glTF and 3DS files: what comes in, what is refused.
#include "scene/mesh/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/scene/mesh_files.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

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

// A mesh of the file without colours, and after it one with: the first's vertices are white.
TEST_F(MeshFile, MakesVerticesWithoutColoursWhiteBesideColouredOnes) {
  std::string text = gltf();
  const std::string from = "\"primitives\": [";
  text.insert(text.find(from) + from.size(), R"({"attributes": {"POSITION": 0}, "indices": 2, "material": 0}, )");
  const std::vector<MeshPart> parts = load_parts(write(text, "mesh.gltf"));
  ASSERT_EQ(parts.size(), 1u);
  const std::vector<glm::vec4>& colors = parts[0].mesh.colors;
  ASSERT_EQ(parts[0].mesh.positions.size(), 6u);
  ASSERT_EQ(colors.size(), 6u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(colors[i], glm::vec4(1)) << i;
  EXPECT_EQ(std::ranges::count(colors, glm::vec4(0, 1, 0, 1)), 1);
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
}

TEST_F(MeshFile, Refuses3ds) {
  refused(write("MMMM", "mesh.3ds"), "expected");
  const std::string whole = test::text_of(fs::path(PLUMBLINE_ASSETS) / "cube.3ds");
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

/// A binary glTF file whose header and first chunk say these lengths [bytes]; 0: the true ones.
std::string glb(const std::string& json, const std::string& data, std::uint32_t length = 0, std::uint32_t first = 0) {
  constexpr std::uint32_t kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
  const auto n = static_cast<std::uint32_t>(json.size()), m = static_cast<std::uint32_t>(data.size());
  return "glTF" + bytes_of<std::uint32_t>({kVersion, length ? length : n + m + 28, first ? first : n, kJson}) + json +
         bytes_of<std::uint32_t>({m, kBinary}) + data;
}

TEST_F(MeshFile, ReadsGlbAndRefusesLengthsBeyondTheFile) {
  const auto refuse = [&](const std::string& bytes, const std::string& expected) {
    refused(write(bytes, "mesh.glb"), expected);
  };
  const std::string data = bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0.5}) +
                           bytes_of<std::uint16_t>({0, 1, 2, 0});
  std::string json = gltf();
  const std::size_t uri = json.find(", \"uri\"");
  json.erase(uri, json.find('}', uri) - uri);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto n = static_cast<std::uint32_t>(json.size());

  const std::string whole = glb(json, data);
  const Mesh mesh = load_one(write(whole, "mesh.glb")), of_text = load_one(write(gltf(), "mesh.gltf"));
  EXPECT_EQ(mesh.positions, of_text.positions);
  EXPECT_EQ(mesh.colors, of_text.colors);
  EXPECT_NO_THROW(load_one(write(whole + "rest", "mesh.glb")));  // bytes beyond the length do not count

  const std::string size = std::to_string(whole.size()), left = std::to_string(whole.size() - 20);
  refuse(glb(json, data, 0xffffffff), "expected a length of at most " + size + " bytes in the header");
  refuse(glb(json, data, n + 28 + 92 + 1), "expected a length of at most " + size);
  refuse(whole.substr(0, whole.size() - 1), "expected a length of at most");
  refuse(glb(json, data, 0, 0xffffffff), "expected a chunk of at most " + left + " bytes at byte 20, found 4294967295");
  refuse(glb(json, data, 0, n + 8 + 92 + 1), "expected a chunk of at most " + left);
  refuse("glTF", "found its end at byte 4 of 12");
  refuse(glb("", "", 12).substr(0, 12), "found its end at byte 12 of 20");
  std::string of_version_1 = whole;
  of_version_1[4] = 1;
  refuse(of_version_1, "expected binary glTF of version 2, found version 1");
  refuse("glTf" + whole.substr(4), "beginning with glTF");
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

}  // namespace
}  // namespace plumbline

// PLY files: what comes in, what is refused.
#include "scene/mesh/mesh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "tests/scene/mesh_files.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

std::string ply(const std::string& vertices, const std::string& faces, int vertex_count = 3, int face_count = 1) {
  return "ply\nformat ascii 1.0\ncomment c\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\nelement face " +
         std::to_string(face_count) + "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

const std::string kPlyVertices = "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 51\n";

std::string bytes_of(auto number, bool big_endian) {
  std::string out(sizeof number, '\0');
  std::memcpy(out.data(), &number, sizeof number);
  if (big_endian) std::reverse(out.begin(), out.end());
  return out;
}

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
    const auto put = [&](auto value) { body += bytes_of(value, big); };
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
    std::string with_sign = header;
    with_sign.replace(with_sign.find("uchar"), 5, "char");
    body[36] = static_cast<char>(-125);
    refused(write(with_sign + body, "mesh.ply"), "expected a list's count, found a negative one in face 0 of 1");
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
  for (const std::string index : {"2.9", "nan", "1e9", "4294967298", "-2147483649"}) {
    refuse(ply(kPlyVertices, "3 0 1 " + index + "\n"),
           "expected an integer from -2147483648 to 2147483647 for vertex_indices, found \"" + index +
               "\" in face 0 of 1");
  }
  refuse(ply("0 0 0 1.5 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n", "3 0 1 2\n"),
         "expected an integer from 0 to 255 for red, found \"1.5\" in vertex 0 of 3");
  std::string of_floats = ply(kPlyVertices, "3 0 1 2\n");
  of_floats.replace(of_floats.find("int vertex_ind"), 3, "float");
  refuse(of_floats, "expected an integer type of PLY for vertex_indices, found \"float\" in the header");
  refuse(ply(kPlyVertices, "2 0 1\n"), "expected faces of three corners or more, found 2 in face 0");
  refuse(ply(kPlyVertices, "4294967295 0 1\n"), "expected a number for vertex_indices");
  refuse(ply("nan 0 0 0 0 0\n1 0 0 0 0 0\n0 1 0 0 0 0\n", "3 0 1 2\n"), "expected coordinates that are finite");
}

std::string ply_of_strips(const std::string& list, const std::string& format = "ascii", int rows = 1) {
  return "ply\r\nformat " + format +
         " 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\nelement tristrips " +
         std::to_string(rows) + "\ncomment strips\nproperty list int int vertex_indices\nend_header\n" + list;
}
/// A band of six vertices, (0, 0), (1, 0), (0, 1), (1, 1) ...
const std::string kBand = "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n";

/// Corners by position, x + 10 y, each triangle's from where it begins in the strip.
using Corners = std::vector<std::array<float, 3>>;
Corners corners_of(const Mesh& mesh) {
  Corners out;
  const auto number = [&](std::uint32_t i) { return mesh.positions[i].x + 10 * mesh.positions[i].y; };
  for (const glm::uvec3& t : mesh.triangles) out.push_back({number(t.x), number(t.y), number(t.z)});
  return out;
}

TEST_F(MeshFile, ReadsPlyStripsAsTriangles) {
  const auto strips = [&](const std::string& rows, int count = 1) {
    return corners_of(load_one(write(ply_of_strips(kBand + rows, "ascii", count), "mesh.ply")));
  };
  EXPECT_EQ(strips("4 0 1 2 3\n"), (Corners{{0, 1, 10}, {10, 1, 11}}));
  EXPECT_EQ(strips("6 0 1 2 3 4 5\n"), (Corners{{0, 1, 10}, {10, 1, 11}, {10, 11, 20}, {20, 11, 21}}));
  // -1 begins a strip: its first triangle is not turned, wherever it stands in the list.
  const Corners two{{0, 1, 10}, {20, 11, 21}};
  EXPECT_EQ(strips("7 0 1 2 -1 4 3 5\n"), two);
  EXPECT_EQ(strips("9 -1 0 1 2 -1 -1 4 3 5\n"), two);
  EXPECT_EQ(strips("9 0 1 2 -1 3 -1 4 3 5\n"), two);
  EXPECT_EQ(strips("3 0 1 2\n4 4 3 5 -1\n", 2), two);
  // A vertex twice: triangles without an area are left out, those after them keep their turn.
  EXPECT_EQ(strips("6 0 1 2 2 3 4\n"), (Corners{{0, 1, 10}, {11, 10, 20}}));
}

TEST_F(MeshFile, ReadsBinaryPlyStripsOfBothByteOrders) {
  for (const bool big : {false, true}) {
    std::string body;
    const auto put = [&](auto value) { body += bytes_of(value, big); };
    for (const int i : {0, 1, 2, 3, 4, 5}) {
      put(static_cast<float>(i % 2));
      put(static_cast<float>(i / 2));
      put(0.0f);
    }
    for (const std::int32_t i : {8, 0, 1, 2, 3, -1, 4, 3, 5}) put(i);
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    EXPECT_EQ(corners_of(load_one(write(ply_of_strips(body, format), "mesh.ply"))),
              (Corners{{0, 1, 10}, {10, 1, 11}, {20, 11, 21}}));
    put(std::int32_t{3});
    for (const std::int32_t i : {0, 1, -2}) put(i);
    refused(write(ply_of_strips(body, format, 2), "mesh.ply"),
            "expected vertices below 6 in tristrips, or -1, found -2");
  }
}

TEST_F(MeshFile, RefusesPlyStrips) {
  const auto refuse = [&](const std::string& text, const std::string& expected) {
    refused(write(text, "mesh.ply"), expected);
  };
  refuse(ply_of_strips(kBand + "3 0 1 6\n"), "expected vertices below 6 in tristrips, or -1, found 6");
  refuse(ply_of_strips(kBand + "3 0 1 2.5\n"), "for vertex_indices, found \"2.5\" in tristrips 0 of 1");
  refuse(ply_of_strips(kBand + "2 0 1\n"), "expected");
  refuse(ply_of_strips(kBand + "4 0 1 2\n"), "expected a number for vertex_indices, found \"\" in tristrips 0 of 1");
  refuse(ply_of_strips(kBand, "ascii", 0), "expected");
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string good = ply_of_strips(kBand + "3 0 1 2\n");
  const std::string others = "expected tristrips with one property, a list vertex_indices of integers, found others";
  refuse(changed(good, "int vertex_indices", "float vertex_indices"),
         "expected an integer type of PLY for vertex_indices, found \"float\" in the header");
  refuse(changed(good, "list int int vertex_indices", "list int int corners"), others);
  refuse(changed(good, "end_header", "property int flags\nend_header") + "3 0 1 2 0\n", "expected");
  refuse(changed(good, "end_header", "element face 1\nproperty list int int vertex_indices\nend_header") + "3 0 1 2\n",
         "expected faces in one element, face or tristrips, found more");
}

}  // namespace
}  // namespace plumbline

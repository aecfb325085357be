// OBJ files: what comes in, what is left out, what is refused.
#include "scene/mesh/mesh_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/scene/mesh_files.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

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
  EXPECT_EQ(parts[1].material->specular, glm::vec4(0, 0, 0, 1));
  EXPECT_EQ(parts[1].material->emission, glm::vec4(0, 0, 0, 1));
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

TEST_F(MeshFile, RefusesOtherFilesThatAreMissingOrElsewhere) {
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  fs::create_directories(root_ / "inner");
  write("newmtl red\nKd 1 0 0\n", "outside.mtl");
  refused(write("mtllib ../outside.mtl\n" + triangle, "inner/mesh.obj"), "outside.mtl\", which is elsewhere");
  write("newmtl red\nKd 2 0 0\n", "bright.mtl");
  refused(write("mtllib bright.mtl\nusemtl red\n" + triangle),
          "expected colours from 0 to 1, found 2 in the material red");
}

TEST_F(MeshFile, LeavesOutMaterialsOfAMissingFileWithANote) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl green\nf 3 2 1\n";
  const auto note_of = [&](const std::string& before) { return load_parts(write(before + mesh)).front().note; };
  const std::string without = "materials of \"" + (root_ / "none.mtl").string() + "\" are left out";
  EXPECT_EQ(note_of("mtllib none.mtl\n").find(without), 0u);
  EXPECT_EQ(note_of("").find("the material \"green\" is left out"), 0u);
  for (const MeshPart& part : load_parts(write(mesh))) EXPECT_FALSE(part.material);

  write("newmtl red\nKd 1 0 0\n", "mesh.mtl");  // which the OBJ file of that name does not ask for
  for (const MeshPart& part : load_parts(write("mtllib none.mtl\n" + mesh))) EXPECT_FALSE(part.material);
  const std::vector<MeshPart> parts = load_parts(write("mtllib none.mtl\nmtllib mesh.mtl\n" + mesh));
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].note.find(without), 0u);
  EXPECT_TRUE(parts[0].material);
  EXPECT_FALSE(parts[1].material);

  refused(write("mtllib mesh.mtl\n" + mesh), "expected materials that the material files define, found \"green\"");
  refused(write("mtllib mesh.mtl none.mtl\n" + mesh), "mesh.mtl none.mtl\", which is no file");
  write("newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\n", "both.mtl");
  EXPECT_EQ(note_of("mtllib both.mtl\n"), "");
}

TEST_F(MeshFile, ReadsThirdTextureCoordinates) {
  const std::string positions = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", f = "f 1/1 2/2 3/3\n";
  for (const std::string third : {"", " 0", " 0.000", " 0.5"}) {
    const std::vector<MeshPart> parts =
        load_parts(write(positions + "vt 0.25 0.5" + third + "\nvt 0.75 0.5\nvt 0.25 1 0\n" + f));
    const Mesh& mesh = parts.front().mesh;
    ASSERT_EQ(mesh.texcoords.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(mesh.texcoords[i], glm::vec2(0.25, 0.5) + 0.5f * glm::vec2(mesh.positions[i])) << third;
    }
    const std::string note =
        third == " 0.5" ? "third texture coordinates, as in line 4, are left out: textures have two" : "";
    EXPECT_EQ(parts.front().note, note);
  }
  const auto refuse = [&](const std::string& vt, const std::string& expected) {
    refused(write(positions + vt + "\nvt 1 0\nvt 0 1\n" + f), expected);
  };
  refuse("vt 0", "expected vt with 2 or 3 numbers, found 1 in line 4");
  refuse("vt 0 0 0 0", "expected vt with 2 or 3 numbers, found 4 in line 4");
  refuse("vt 0 .5", "expected a number that begins with a sign or a digit, found \".5\" in line 4");
  refuse("vt 0 x", "expected a number that begins with a sign or a digit, found \"x\" in line 4");
}

TEST_F(MeshFile, ReadsFacesOfOneForm) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\n";
  refused(write(corners + "f 1 2/2 3/3\n"), "expected corners with v as the face's first has, found \"2/2\" in line 8");
  refused(write(corners + "f 1/1 2 3\n"), "expected corners with v vt as the face's first has, found \"2\" in line 8");
  refused(write(corners + "f 1/1/1 2//1 3/3/1\n"), "with v vt vn as the face's first has, found \"2//1\"");
  const std::vector<MeshPart> parts = load_parts(write(corners + "f 1/1 2/2 3/3\nf 1 2 3\n"));
  EXPECT_EQ(parts.front().note, "faces with and without vt, up to line 9: texture coordinates without are 0");
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

}  // namespace
}  // namespace plumbline

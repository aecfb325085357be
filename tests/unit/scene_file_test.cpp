// Scene files: what a good one means, and that every bad one is refused at the place where it is bad.
#include "scene/scene_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// A folder per test, "<temporary>/<test's name>/group".
class SceneFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(testing::TempDir()) / (std::string("plumbline_scene_file_") + info->name());
    fs::remove_all(root_);
    fs::create_directories(root_ / "group");
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path write(const std::string& text, const std::string& name = "group/scene.json") const {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name, std::ios::binary) << text;
    return root_ / name;
  }
  Scene load(const std::string& text) const { return load_scene(write(text), {.asset_folders = {root_ / "assets"}}); }

  /// Refused with a message that names the file, the pointer and what was expected.
  void refused(const std::string& text, const std::string& pointer, const std::string& expected) const {
    try {
      load(text);
      ADD_FAILURE() << "not refused: " << text;
    } catch (const SceneError& error) {
      const std::string what = error.what();
      EXPECT_NE(what.find("scene.json: at \"" + pointer + "\": expected "), what.npos) << text << "\n" << what;
      EXPECT_NE(what.find(expected), what.npos) << text << "\n" << what;
      EXPECT_NE(what.find(", found "), what.npos) << what;
    }
  }
  /// A scene that is good but for what is put before the draws.
  void refused_top(const std::string& extra, const std::string& pointer, const std::string& expected) const {
    refused(R"({"description": "d", )" + extra + R"(, "draws": [{"mesh": {"grid": {"columns": 1, "rows": 1}}}]})",
            pointer, expected);
  }
  /// A scene that is good but for what is put beside the mesh of its draw.
  void refused_draw(const std::string& extra, const std::string& pointer, const std::string& expected) const {
    refused(R"({"description": "d", "draws": [{"mesh": {"grid": {"columns": 1, "rows": 1}}, )" + extra + "}]}",
            "/draws/0" + pointer, expected);
  }
  void refused_mesh(const std::string& mesh, const std::string& pointer, const std::string& expected) const {
    refused(R"({"description": "d", "draws": [{"mesh": )" + mesh + "}]}", "/draws/0/mesh" + pointer, expected);
  }

  fs::path root_;
};

TEST_F(SceneFile, ReadsEveryKey) {
  const Scene s = load(R"({
    // a comment
    "description": "everything", "dialect": "gl",
    "frame": {"width": 97, "height": 61, "color": "rgba32f", "depth": "z32f", "clear_color": [0.1, 0.2, 0.3, 0.4],
              "clear_depth": 0.5},
    "camera": {"eye": [1, 2, 3], "center": [4, 5, 6], "up": [0, 0, 2]},
    "projection": {"orthographic": {"left": -1, "right": 2, "bottom": -3, "top": 4, "near": -5, "far": 6}},
    "ambient": [0.1, 0.2, 3],
    "lights": [{"directional": [0, 0, 7], "ambient": [0, 0.5, 2]},
               {"point": [1, 2, 3], "diffuse": [1, 2, 3], "specular": [4, 5, 6]}],
    "draws": [{
      "mesh": {"triangle": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0.1]],
                            "colors": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 0.5]]}},
      "transforms": [{"translate": [1, 2, 3]}, {"rotate": {"degrees": 30, "axis": [0, 2, 0]}}, {"scale": [1, -2, 3]}],
      "material": {"ambient": [0, 0.1, 0.2, 1], "diffuse": [0.3, 0.4, 0.5, 1], "specular": [0.6, 0.7, 0.8, 1],
                   "emission": [0.9, 1, 0, 1], "shininess": 12.5},
      "lit": false, "shading": "flat", "cull": "front", "depth_func": "not_equal"}]})");
  EXPECT_EQ(s.name, "group/scene");
  EXPECT_EQ(s.path, (root_ / "group/scene.json").string());
  EXPECT_EQ(s.description, "everything");
  EXPECT_EQ(s.frame.width, 97);
  EXPECT_EQ(s.frame.height, 61);
  EXPECT_EQ(s.frame.color, ColorFormat::rgba32f);
  EXPECT_EQ(s.frame.depth, DepthFormat::z32f);
  EXPECT_EQ(s.frame.clear_color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(s.frame.clear_depth, 0.5);
  EXPECT_EQ(s.camera.eye, glm::dvec3(1, 2, 3));
  EXPECT_EQ(s.camera.center, glm::dvec3(4, 5, 6));
  EXPECT_EQ(s.camera.up, glm::dvec3(0, 0, 2));
  const auto& o = std::get<Orthographic>(s.projection);
  EXPECT_EQ((std::array{o.left, o.right, o.bottom, o.top, o.near, o.far}), (std::array{-1., 2., -3., 4., -5., 6.}));
  EXPECT_EQ(s.ambient, glm::vec3(0.1f, 0.2f, 3));
  ASSERT_EQ(s.lights.size(), 2u);
  EXPECT_EQ(s.lights[0].kind, Light::Kind::directional);
  EXPECT_EQ(s.lights[0].vector, glm::dvec3(0, 0, 7));
  EXPECT_EQ(s.lights[0].ambient, glm::vec3(0, 0.5f, 2));
  EXPECT_EQ(s.lights[0].diffuse, Light{}.diffuse);
  EXPECT_EQ(s.lights[1].kind, Light::Kind::point);
  EXPECT_EQ(s.lights[1].diffuse, glm::vec3(1, 2, 3));
  EXPECT_EQ(s.lights[1].specular, glm::vec3(4, 5, 6));
  ASSERT_EQ(s.meshes.size(), 1u);
  EXPECT_EQ(s.meshes[0].positions[2], glm::vec3(0, 1, 0.1f));
  EXPECT_EQ(s.meshes[0].colors[2], glm::vec4(0, 0, 1, 0.5f));
  EXPECT_EQ(s.meshes[0].triangles, std::vector{glm::uvec3(0, 1, 2)});
  ASSERT_EQ(s.draws.size(), 1u);
  const Draw& d = s.draws[0];
  ASSERT_EQ(d.transforms.size(), 3u);
  EXPECT_EQ(std::get<Translate>(d.transforms[0]).by, glm::dvec3(1, 2, 3));
  EXPECT_EQ(std::get<Rotate>(d.transforms[1]).degrees, 30);
  EXPECT_EQ(std::get<Rotate>(d.transforms[1]).axis, glm::dvec3(0, 2, 0));
  EXPECT_EQ(std::get<Scale>(d.transforms[2]).by, glm::dvec3(1, -2, 3));
  EXPECT_EQ(d.material.ambient, glm::vec4(0, 0.1f, 0.2f, 1));
  EXPECT_EQ(d.material.diffuse, glm::vec4(0.3f, 0.4f, 0.5f, 1));
  EXPECT_EQ(d.material.specular, glm::vec4(0.6f, 0.7f, 0.8f, 1));
  EXPECT_EQ(d.material.emission, glm::vec4(0.9f, 1, 0, 1));
  EXPECT_EQ(d.material.shininess, 12.5f);
  EXPECT_FALSE(d.lit);
  EXPECT_EQ(d.shading, Shading::flat);
  EXPECT_EQ(d.cull, Cull::front);
  EXPECT_EQ(d.depth_func, DepthFunc::not_equal);
}

TEST_F(SceneFile, LeavesDefaults) {
  const Scene s = load(R"({"description": "d", "draws": [{"mesh": {"uv_sphere": {"slices": 3, "stacks": 2}}}]})");
  const Scene plain;
  EXPECT_EQ(s.frame.width, plain.frame.width);
  EXPECT_EQ(s.frame.depth, plain.frame.depth);
  EXPECT_EQ(s.camera.eye, plain.camera.eye);
  EXPECT_EQ(std::get<Perspective>(s.projection).fov_y_degrees, 45);
  EXPECT_TRUE(s.lights.empty());
  EXPECT_TRUE(s.draws[0].lit);
  EXPECT_EQ(s.draws[0].depth_func, DepthFunc::less);
  EXPECT_EQ(s.draws[0].material.diffuse, Material{}.diffuse);
}

TEST_F(SceneFile, DrawsOfAnEqualMeshShareIt) {
  const Scene s = load(R"({"description": "d", "draws": [
      {"mesh": {"grid": {"columns": 1, "rows": 2}}}, {"mesh": {"grid": {"columns": 2, "rows": 1}}},
      {"mesh": {"grid": {"rows": 2, "columns": 1}}}]})");
  EXPECT_EQ(s.meshes.size(), 2u);
  EXPECT_EQ(s.draws[0].mesh, 0u);
  EXPECT_EQ(s.draws[1].mesh, 1u);
  EXPECT_EQ(s.draws[2].mesh, 0u);
}

TEST_F(SceneFile, FindsMeshFilesInItsFolderThenInTheAssets) {
  write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "group/parts/own.obj");
  write("v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n", "assets/parts/own.obj");
  write("v 0 0 0\nv 3 0 0\nv 0 3 0\nf 1 2 3\n", "assets/shared.obj");
  const Scene s = load(R"({"description": "d", "draws": [{"mesh": {"file": "parts/own.obj"}},
                                                         {"mesh": {"file": "shared.obj"}}]})");
  EXPECT_EQ(s.meshes[0].positions[1].x, 1);
  EXPECT_EQ(s.meshes[1].positions[1].x, 3);
}

TEST_F(SceneFile, RefusesMeshFiles) {
  refused_mesh(R"({"file": "none.obj"})", "/file", "a mesh file");
  refused_mesh(R"({"file": "none.obj"})", "/file", (root_ / "group").string() + ", " + (root_ / "assets").string());
  refused_mesh(R"({"file": "none.obj"})", "/file", "scripts/setup installs the package glmark2-data");
  write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "outside.obj");
  refused_mesh(R"({"file": "../outside.obj"})", "/file", "without \"..\"");
  refused_mesh(R"({"file": "parts/../../outside.obj"})", "/file", "without \"..\"");
  refused_mesh("{\"file\": \"" + (root_ / "outside.obj").string() + "\"}", "/file", "a path below");
  write("not a mesh", "group/broken.obj");
  refused_mesh(R"({"file": "broken.obj"})", "/file", "a mesh file that can be used");
  refused_mesh(R"({"file": 3})", "/file", "a string");
  EXPECT_THROW(load(R"({"description": "d", "draws": [{"mesh": {"file": ")" + std::string(5000, 'x') + "\"}}]}"),
               SceneError);
}

TEST_F(SceneFile, RefusesWhatIsNotAScene) {
  refused("", "", "JSON");
  refused("{\"description\": ", "/description", "JSON");
  refused(R"({"description": "d", "draws": [{"mesh": nan}]})", "/draws/0/mesh", "JSON");
  refused(R"({"description": "d"} 3)", "", "JSON");
  refused("[]", "", "an object");
  refused("\"\xff\"", "", "JSON");
  refused(
      std::string(100000, '['),
      [] {
        std::string p;
        for (int i = 0; i < 64; ++i) p += "/0";
        return p;
      }(),
      "64 levels");
  EXPECT_THROW(load_scene(root_ / "none.json"), SceneError);
  EXPECT_THROW(load_scene(root_ / "group"), SceneError);
}

TEST_F(SceneFile, RefusesDuplicateKeysAtAnyDepth) {
  refused(R"({"description": "d", "description": "e", "draws": []})", "/description", "each key once");
  refused_draw(R"("material": {"shininess": 1, "shininess": 1})", "/material/shininess", "each key once");
}

TEST_F(SceneFile, RefusesUnknownKeysEverywhere) {
  refused_top(R"("lens": 1)", "/lens", "a key among description");
  refused_top(R"("a/b~c": 1)", "/a~1b~0c", "a key among");
  refused_top(R"("frame": {"depht": "z16"})", "/frame/depht", "a key among");
  refused_top(R"("camera": {"target": [0, 0, 0]})", "/camera/target", "a key among");
  refused_top(R"("projection": {"fisheye": {}})", "/projection/fisheye", "a key among");
  refused_top(R"("projection": {"perspective": {"fov_y": 9, "near": 1, "far": 2, "x": 1}})",
              "/projection/perspective/x", "a key among");
  refused_top(R"("lights": [{"spot": [0, 0, 1]}])", "/lights/0/spot", "a key among");
  refused_draw(R"("culling": "none")", "/culling", "a key among");
  refused_draw(R"("material": {"color": [0, 0, 0, 1]})", "/material/color", "a key among");
  refused_draw(R"("transforms": [{"shear": [0, 0, 0]}])", "/transforms/0/shear", "a key among");
  refused_draw(R"("transforms": [{"rotate": {"degrees": 1, "axis": [0, 0, 1], "x": 1}}])", "/transforms/0/rotate/x",
               "a key among");
  refused_mesh(R"({"teapot": {}})", "/teapot", "a key among");
  refused_mesh(R"({"grid": {"columns": 1, "rows": 1, "x": 1}})", "/grid/x", "a key among");
}

TEST_F(SceneFile, RefusesMissingKeys) {
  refused(R"({"draws": []})", "/description", "nothing: the key is missing");
  refused(R"({"description": ""})", "/description", "a string that is not empty");
  refused(R"({"description": "d"})", "/draws", "nothing: the key is missing");
  refused(R"({"description": "d", "draws": []})", "/draws", "an array of 1 or more");
  refused(R"({"description": "d", "draws": [{}]})", "/draws/0/mesh", "nothing: the key is missing");
  refused_top(R"("projection": {})", "/projection", "exactly one of the keys perspective, orthographic");
  refused_top(R"("projection": {"perspective": {"fov_y": 45, "near": 1}})", "/projection/perspective/far", "missing");
  refused_top(R"("projection": {"orthographic": {"left": 0, "right": 1, "bottom": 0, "near": 1, "far": 2}})",
              "/projection/orthographic/top", "missing");
  refused_top(R"("lights": [{"ambient": [0, 0, 0]}])", "/lights/0", "exactly one of the keys directional, point");
  refused_top(R"("lights": [{"point": [0, 0, 0], "directional": [0, 0, 1]}])", "/lights/0", "exactly one of the keys");
  refused_draw(R"("transforms": [{}])", "/transforms/0", "exactly one of the keys");
  refused_draw(R"("transforms": [{"scale": [1, 1, 1], "translate": [0, 0, 0]}])", "/transforms/0", "exactly one");
  refused_draw(R"("transforms": [{"rotate": {"degrees": 3}}])", "/transforms/0/rotate/axis", "missing");
  refused_mesh("{}", "", "exactly one of the keys");
  refused_mesh(R"({"soup": {"triangles": 1, "seed": 1, "extent": 1}})", "/soup/size", "missing");
}

TEST_F(SceneFile, RefusesWrongTypes) {
  refused(R"({"description": 3, "draws": []})", "/description", "a string");
  refused(R"({"description": "d", "draws": {}})", "/draws", "an array");
  refused_top(R"("dialect": "vulkan")", "/dialect", "one of gl");
  refused_top(R"("frame": 3)", "/frame", "an object");
  refused_top(R"("frame": {"width": 64.5})", "/frame/width", "an integer from 1 to 16384");
  refused_top(R"("frame": {"width": "64"})", "/frame/width", "an integer from 1 to 16384");
  refused_top(R"("frame": {"color": "rgb8"})", "/frame/color", "one of rgba8, rgba32f");
  refused_top(R"("frame": {"color": 8})", "/frame/color", "one of rgba8, rgba32f");
  refused_top(R"("frame": {"depth": "z8"})", "/frame/depth", "one of z16, z24, z32f");
  refused_top(R"("frame": {"clear_color": [0, 0, 0]})", "/frame/clear_color", "an array of 4");
  refused_top(R"("camera": {"eye": [0, 0, "5"]})", "/camera/eye/2", "a number");
  refused_top(R"("lights": [{"point": [0, 0]}])", "/lights/0/point", "an array of 3");
  refused_draw(R"("lit": 1)", "/lit", "true or false");
  refused_draw(R"("shading": "phong")", "/shading", "one of flat, gouraud");
  refused_draw(R"("cull": true)", "/cull", "one of none, back, front");
  refused_draw(R"("depth_func": "lequal")", "/depth_func", "one of never, less");
  refused_draw(R"("transforms": {"translate": [0, 0, 0]})", "/transforms", "an array");
  refused_draw(R"("material": {"diffuse": [0, 0, 0]})", "/material/diffuse", "an array of 4");
  refused_mesh("\"bunny.obj\"", "", "an object");
}

TEST_F(SceneFile, RefusesNumbersOutOfRange) {
  refused_top(R"("camera": {"eye": [0, 0, 1e999]})", "/camera/eye/2", "a finite number");
  refused_top(R"("camera": {"eye": [-1e999, 0, 0]})", "/camera/eye/0", "a finite number");
  refused_top(R"("camera": {"eye": [0, 0, 1e300]})", "/camera/eye/2", "a number from -1000000 to 1000000");
  refused_top(R"("frame": {"width": 0})", "/frame/width", "an integer from 1 to 16384");
  refused_top(R"("frame": {"height": 16385})", "/frame/height", "an integer from 1 to 16384");
  refused_top(R"("frame": {"height": 18446744073709551617})", "/frame/height", "an integer from 1 to 16384");
  refused_top(R"("frame": {"height": -9223372036854775809})", "/frame/height", "an integer from 1 to 16384");
  refused_top(R"("frame": {"clear_depth": 1.5})", "/frame/clear_depth", "a number from 0 to 1");
  refused_top(R"("frame": {"clear_color": [0, 0, 0, 2]})", "/frame/clear_color/3", "a number from 0 to 1");
  refused_top(R"("ambient": [0, -0.1, 0])", "/ambient/1", "a number from 0");
  refused_top(R"("lights": [{"point": [0, 0, 0], "specular": [0, 0, -1]}])", "/lights/0/specular/2", "a number from 0");
  refused_draw(R"("material": {"diffuse": [0, 1.01, 0, 1]})", "/material/diffuse/1", "a number from 0 to 1");
  refused_draw(R"("material": {"shininess": 128.5})", "/material/shininess", "a number from 0 to 128");
  refused_draw(R"("material": {"shininess": -1})", "/material/shininess", "a number from 0 to 128");
  refused_mesh(R"({"grid": {"columns": 0, "rows": 1}})", "/grid/columns", "an integer from 1");
  refused_mesh(R"({"grid": {"columns": 1, "rows": 100000}})", "/grid/rows", "an integer from 1");
  refused_mesh(R"({"uv_sphere": {"slices": 2, "stacks": 2}})", "/uv_sphere/slices", "an integer from 3");
  refused_mesh(R"({"uv_sphere": {"slices": 3, "stacks": 1}})", "/uv_sphere/stacks", "an integer from 2");
  refused_mesh(R"({"soup": {"triangles": 1, "seed": -1, "extent": 1, "size": 1}})", "/soup/seed", "an integer from 0");
  refused_mesh(R"({"triangle": {"positions": [[0, 0, 0], [1, 0, 0]]}})", "/triangle/positions", "an array of 3");
  refused_mesh(R"({"triangle": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], "colors": [[0, 0, 0, 1]]}})",
               "/triangle/colors", "an array of 3");
  const std::string p = R"({"triangles": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]], )";
  refused_mesh(p + R"("indices": [[0, 1, 2], [0, 1, 3]]}})", "/triangles/indices/1/2", "an integer from 0 to 2");
  refused_mesh(p + R"("indices": [[0, 1, 1]]}})", "/triangles/indices/0", "three different indices");
  refused_mesh(p + R"("indices": []}})", "/triangles/indices", "an array of 1 or more");
}

TEST_F(SceneFile, RefusesWhatHasNoMeaning) {
  refused_top(R"("camera": {"eye": [1, 2, 3], "center": [1, 2, 3]})", "/camera", "eye and center to differ");
  refused_top(R"("camera": {"eye": [0, 5, 0], "up": [0, -2, 0]})", "/camera", "up not to be parallel");
  refused_top(R"("camera": {"up": [0, 0, 0]})", "/camera/up", "not zero");
  refused_top(R"("projection": {"perspective": {"fov_y": 45, "near": 0, "far": 2}})", "/projection/perspective/near",
              "a number from");
  refused_top(R"("projection": {"perspective": {"fov_y": 45, "near": 2, "far": 2}})", "/projection/perspective/far",
              "greater than near");
  refused_top(R"("projection": {"perspective": {"fov_y": 180, "near": 1, "far": 2}})", "/projection/perspective/fov_y",
              "a number from");
  const std::string ortho = R"("projection": {"orthographic": {"bottom": 0, )";
  refused_top(ortho + R"("left": 1, "right": 1, "top": 1, "near": 0, "far": 1}})", "/projection/orthographic/right",
              "other than left");
  refused_top(ortho + R"("left": 0, "right": 1, "top": 0, "near": 0, "far": 1}})", "/projection/orthographic/top",
              "other than bottom");
  refused_top(ortho + R"("left": 0, "right": 1, "top": 1, "near": 1, "far": -1}})", "/projection/orthographic/far",
              "greater than near");
  refused_top(R"("lights": [{"directional": [0, 0, 0]}])", "/lights/0/directional", "not zero");
  std::string nine = R"({"point": [0, 0, 0]})";
  for (int i = 1; i < 9; ++i) nine += R"(, {"point": [0, 0, 0]})";
  refused_top("\"lights\": [" + nine + "]", "/lights", "an array of 0 to 8");
  refused_draw(R"("transforms": [{"rotate": {"degrees": 3, "axis": [0, 0, 0]}}])", "/transforms/0/rotate/axis",
               "not zero");
  refused_draw(R"("transforms": [{"scale": [1, 0, 1]}])", "/transforms/0/scale/1", "a scale that is not zero");
  refused_draw(R"("transforms": [{"scale": [1e5, 1, 1]}, {"scale": [1e5, 1, 1]}])", "/transforms/1",
               "scales whose product");
}

TEST_F(SceneFile, FindsScenes) {
  const std::string good = "{}";
  const fs::path b = write(good, "group/b.json"), a = write(good, "group/a.json"), c = write(good, "group/deep/c.json");
  write("", "group/readme.txt");
  const auto find = [](std::vector<fs::path> paths) { return find_scenes(paths); };
  EXPECT_EQ(find({root_ / "group"}), (std::vector{a, b, c}));
  EXPECT_EQ(find({b, root_ / "group/deep"}), (std::vector{b, c}));
  EXPECT_THROW(find({}), SceneError);
  EXPECT_THROW(find({root_ / "none"}), SceneError);
  fs::create_directories(root_ / "empty");
  EXPECT_THROW(find({root_ / "empty"}), SceneError);
}

TEST(Scenes, AllLoadAndEveryStateOccurs) {
  std::set<std::string> names, states;
  const std::vector<fs::path> folder{fs::path(PLUMBLINE_SOURCE_DIR) / "tests/scenes"};
  for (const fs::path& file : find_scenes(folder)) {
    const Scene s = load_scene(file);
    EXPECT_TRUE(names.insert(s.name).second) << s.name;
    const auto seen = [&](const char* what, auto value) {
      states.insert(what + std::to_string(static_cast<int>(value)));
    };
    seen("color ", s.frame.color);
    seen("depth ", s.frame.depth);
    seen("projection ", s.projection.index());
    for (const Light& light : s.lights) seen("light ", light.kind);
    for (const Draw& draw : s.draws) {
      seen("lit ", draw.lit);
      seen("shading ", draw.shading);
      seen("cull ", draw.cull);
      seen("func ", draw.depth_func);
      for (const Transform& transform : draw.transforms) seen("transform ", transform.index());
    }
  }
  EXPECT_EQ(states.size(), 2u + 3 + 3 + 2 + 2 + 2 + 3 + 8 + 3);
}

}  // namespace
}  // namespace plumbline

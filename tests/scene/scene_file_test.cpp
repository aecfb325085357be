// Scene files: what a good one means. (The bad ones: tests/cli/bad_scenes.h.)
#include "scene/file/scene_file.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <string>
#include <vector>
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// A folder per test, "<temporary>/<test's name>/group".
class SceneFile : public TestFolder {
 protected:
  void SetUp() override { fs::create_directories(root_ / "group"); }

  fs::path write(const std::string& text, const std::string& name = "group/scene.json") const {
    fs::create_directories((root_ / name).parent_path());
    test::write_text(root_ / name, text);
    return root_ / name;
  }
  Scene load(const std::string& text) const { return load_scene(write(text), {.asset_folders = {root_ / "assets"}}); }
};

TEST_F(SceneFile, ReadsTheLightModelAndWhatALampHas) {
  const Scene s = load(R"({
    "description": "d",
    "light_model": {"local_viewer": true, "specular": "reflection", "sides": "flip", "separate_specular": true},
    "lights": [{"point": [1, 2, 3], "attenuation": [0, 0.5, 2],
                "spot": {"direction": [0, 0, -3], "cutoff": 22.5, "exponent": 128}},
               {"point": [0, 0, 0], "spot": {"direction": [0, 1, 0], "cutoff": 90}},
               {"point": [0, 0, 0]}],
    "draws": [{"mesh": {"cube": {}}, "color_material": "ambient_and_diffuse", "normals": "as_they_are"},
              {"mesh": {"cube": {}}, "back_material": {"shininess": 5}, "shading": "phong"}]})");
  EXPECT_TRUE(s.light_model.separate_specular);
  EXPECT_FALSE(s.draws[0].back_material);
  ASSERT_TRUE(s.draws[1].back_material);
  EXPECT_EQ(s.draws[1].back_material->shininess, 5);
  EXPECT_EQ(s.draws[1].back_material->diffuse, Material{}.diffuse);
  EXPECT_EQ(s.draws[1].shading, Shading::phong);
  EXPECT_TRUE(s.light_model.local_viewer);
  EXPECT_EQ(s.light_model.specular, LightModel::Specular::reflection);
  EXPECT_EQ(s.light_model.sides, LightModel::Sides::flip);
  EXPECT_EQ(s.light_model.ambient, glm::vec3(0));
  EXPECT_EQ(s.lights[0].attenuation, glm::vec3(0, 0.5f, 2));
  ASSERT_TRUE(s.lights[0].spot && s.lights[1].spot);
  EXPECT_EQ(s.lights[0].spot->direction, glm::dvec3(0, 0, -3));
  EXPECT_EQ(s.lights[0].spot->cutoff_degrees, 22.5);
  EXPECT_EQ(s.lights[0].spot->exponent, 128);
  EXPECT_EQ(s.lights[1].spot->exponent, 0);
  EXPECT_FALSE(s.lights[2].spot);
  EXPECT_EQ(s.lights[2].attenuation, glm::vec3(1, 0, 0));
  EXPECT_EQ(s.draws[0].color_material, ColorMaterial::ambient_and_diffuse);
  EXPECT_EQ(s.draws[0].normals, Normals::as_they_are);
}

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
  EXPECT_EQ(s.light_model.ambient, glm::vec3(0.1f, 0.2f, 3));
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

TEST_F(SceneFile, TakesTrianglesNormalsOfUnitLengthAsTheyAre) {
  const auto mesh = [](const std::string& normal) {
    return R"({"description": "d", "draws": [{"mesh": {"triangles": {"positions": [[0, 0, 0], [1, 0, 0], [0, 1, 0]],
               "indices": [[0, 1, 2]], "normals": [[0, 0, 1], [0.577, 0.577, 0.577], )" +
           normal + "]}}}]}";
  };
  const Scene s = load(mesh("[0.8, 0, -0.6]"));
  EXPECT_EQ(s.meshes[0].normals, (std::vector<glm::vec3>{{0, 0, 1}, glm::vec3(0.577f), {0.8f, 0, -0.6f}}));
  EXPECT_THROW(load(mesh("[0, 0, 1.002]")), SceneError);
  EXPECT_THROW(load(mesh("[0, 0, 0]")), SceneError);
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

TEST_F(SceneFile, ADialectHasItsOwnDefaults) {
  const auto read = [&](const std::string& dialect, const std::string& rest = "") {
    return load(R"({"description": "d", "dialect": ")" + dialect + R"(", "draws": [{"mesh": {"cube": {}}}])" + rest +
                "}");
  };
  const Scene gz = read("gzrender"), games = read("games101"), tiny = read("tinyrenderer");
  EXPECT_EQ(std::get<ViewPlane>(gz.projection).fov_degrees, 45);
  EXPECT_EQ(gz.draws[0].depth_func, DepthFunc::less);
  EXPECT_EQ(gz.frame.clear_depth, 1);
  EXPECT_EQ(std::get<Perspective>(games.projection).near, -1);
  EXPECT_EQ(std::get<Pinhole>(tiny.projection).c, 5);  // from (0, 0, 5) to the origin
  for (const Scene* scene : {&games, &tiny}) {
    EXPECT_EQ(scene->draws[0].depth_func, DepthFunc::greater);
    EXPECT_EQ(scene->frame.clear_depth, 0);
  }
  EXPECT_TRUE(tiny.depth_clamp);
  EXPECT_FALSE(games.depth_clamp || gz.depth_clamp);
  const Scene said = read("games101", R"(, "frame": {"clear_depth": 0.5}, "defaults": {"depth_func": "always"})");
  EXPECT_EQ(said.frame.clear_depth, 0.5);
  EXPECT_EQ(said.draws[0].depth_func, DepthFunc::always);
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

TEST_F(SceneFile, ReadsHowFragmentsAreTested) {
  const Scene s = load(R"({"description": "d", "frame": {"stencil": "s8", "clear_stencil": 200},
    "defaults": {"polygon_offset": {"units": 3}}, "draws": [
      {"mesh": {"cube": {}}},
      {"mesh": {"cube": {}}, "polygon_offset": {"factor": -1.5, "units": 2}, "logic_op": "equivalent",
       "alpha_test": {"func": "greater_equal", "reference": 0.25},
       "stencil": {"func": "less", "reference": 3, "mask": 15, "fail": "zero", "depth_fail": "increment_wrap",
                   "pass": "invert", "write_mask": 240, "back": {"reference": 4, "pass": "decrement"}}}]})");
  EXPECT_EQ(s.frame.stencil, StencilFormat::s8);
  EXPECT_EQ(s.frame.clear_stencil, 200);
  const Draw &plain = s.draws[0], &all = s.draws[1];
  EXPECT_EQ(plain.polygon_offset, (PolygonOffset{0, 3}));
  EXPECT_FALSE(plain.alpha_test || plain.stencil || plain.merge.logic_op);
  EXPECT_EQ(all.polygon_offset, (PolygonOffset{-1.5f, 2}));
  EXPECT_EQ(all.merge.logic_op, LogicOp::equivalent);
  ASSERT_TRUE(all.alpha_test && all.stencil);
  EXPECT_EQ(all.alpha_test->func, CompareFunc::greater_equal);
  EXPECT_EQ(all.alpha_test->reference, 0.25f);
  const StencilFace &front = all.stencil->front, &back = all.stencil->back;
  EXPECT_EQ(front.reference, 3);
  EXPECT_EQ(back.reference, 4);
  EXPECT_EQ(front.pass, StencilOp::invert);
  EXPECT_EQ(back.pass, StencilOp::decrement);
  for (const StencilFace& face : {front, back}) {
    EXPECT_EQ(face.func, CompareFunc::less);
    EXPECT_EQ(face.mask, 15);
    EXPECT_EQ(face.fail, StencilOp::zero);
    EXPECT_EQ(face.depth_fail, StencilOp::increment_wrap);
    EXPECT_EQ(face.write_mask, 240);
  }
}

TEST_F(SceneFile, ReadsHowFragmentsAreMerged) {
  const Scene s = load(R"({"description": "d", "defaults": {"depth_mask": false}, "draws": [
      {"mesh": {"cube": {}}},
      {"mesh": {"cube": {}}, "blend": {}, "depth_mask": true, "color_mask": [true, false, true, false],
                              "depth_range": [0.75, 0.25], "scissor": [1, 2, 30, 16384]},
      {"mesh": {"cube": {}}, "blend": {"source": "source_alpha_saturate", "destination": "constant_color",
                                       "equation": "reverse_subtract", "color": [0.1, 0.2, 0.3, 0.4]}},
      {"mesh": {"cube": {}}, "blend": {"destination": "one", "alpha": {"source": "zero", "equation": "max"}}}]})");
  const Merge &none = s.draws[0].merge, &plain = s.draws[1].merge, &both = s.draws[2].merge, &own = s.draws[3].merge;
  EXPECT_FALSE(none.blend);
  EXPECT_FALSE(none.depth_mask);
  EXPECT_EQ(s.draws[0].depth_range, DepthRange{});
  EXPECT_EQ(s.draws[1].depth_range, (DepthRange{0.75f, 0.25f}));
  EXPECT_FALSE(s.draws[0].scissor);
  ASSERT_TRUE(s.draws[1].scissor);
  const Scissor& box = *s.draws[1].scissor;
  EXPECT_EQ(glm::ivec4(box.x, box.y, box.width, box.height), glm::ivec4(1, 2, 30, 16384));
  EXPECT_EQ(none.color_mask, glm::bvec4(true));
  ASSERT_TRUE(plain.blend && both.blend && own.blend);
  EXPECT_TRUE(plain.depth_mask);
  EXPECT_EQ(plain.color_mask, glm::bvec4(true, false, true, false));
  const auto is = [](const BlendTerm& t, BlendFactor source, BlendFactor destination, BlendEquation equation) {
    return t.source == source && t.destination == destination && t.equation == equation;
  };
  using F = BlendFactor;
  for (const BlendTerm& t : {plain.blend->rgb, plain.blend->alpha}) {
    EXPECT_TRUE(is(t, F::one, F::zero, BlendEquation::add));
  }
  for (const BlendTerm& t : {both.blend->rgb, both.blend->alpha}) {
    EXPECT_TRUE(is(t, F::source_alpha_saturate, F::constant_color, BlendEquation::reverse_subtract));
  }
  EXPECT_EQ(both.blend->color, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_TRUE(is(own.blend->rgb, F::one, F::one, BlendEquation::add));
  EXPECT_TRUE(is(own.blend->alpha, F::zero, F::one, BlendEquation::max));
}

TEST_F(SceneFile, ReadsHowFacesLinesAndPointsAreDrawn) {
  const Scene s = load(R"({"description": "d", "frame": {"color": "rgba16"}, "defaults": {"line_width": 3},
      "draws": [{"mesh": {"cube": {}}},
                {"mesh": {"cube": {}}, "front_mode": "point", "back_mode": "line", "line_width": 16, "point_size": 64},
                {"mesh": {"points": {"positions": [[0, 0, 0]]}}, "front_mode": "fill"}]})");
  EXPECT_EQ(s.frame.color, ColorFormat::rgba16);
  const Draw &plain = s.draws[0], &all = s.draws[1];
  EXPECT_TRUE(plain.front_mode == PolygonMode::fill && plain.back_mode == PolygonMode::fill);
  EXPECT_TRUE(all.front_mode == PolygonMode::point && all.back_mode == PolygonMode::line);
  EXPECT_EQ(glm::ivec2(plain.line_width, plain.point_size), glm::ivec2(3, 1));
  EXPECT_EQ(glm::ivec2(all.line_width, all.point_size), glm::ivec2(16, 64));
  Scene one = s;
  for (const std::size_t i : {0u, 1u, 2u}) {
    one.draws = {s.draws[i]};
    EXPECT_EQ(may_draw(one, Topology::triangles), i == 0) << i;
    EXPECT_EQ(may_draw(one, Topology::lines), i == 1) << i;
    EXPECT_EQ(may_draw(one, Topology::points), i != 0) << i;
  }
}

TEST_F(SceneFile, DefaultsCountWhereADrawSaysNothing) {
  const Scene s = load(R"({"description": "d",
      "defaults": {"shading": "flat", "cull": "back", "lit": false, "depth_func": "always",
                   "transforms": [{"translate": [1, 0, 0]}],
                   "material": {"diffuse": [1, 0, 0, 1], "shininess": 5}},
      "draws": [{"mesh": {"cube": {}}},
                {"mesh": {"quad": {}}, "shading": "gouraud", "transforms": [], "material": {"diffuse": [0, 1, 0, 1]}}]})");
  EXPECT_EQ(s.draws[0].shading, Shading::flat);
  EXPECT_EQ(s.draws[0].transforms.size(), 1u);
  EXPECT_EQ(s.draws[0].material.diffuse, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(s.draws[1].shading, Shading::gouraud);
  EXPECT_TRUE(s.draws[1].transforms.empty());
  EXPECT_EQ(s.draws[1].material.diffuse, glm::vec4(0, 1, 0, 1));
  for (const Draw& draw : s.draws) {
    EXPECT_EQ(draw.cull, Cull::back);
    EXPECT_FALSE(draw.lit);
    EXPECT_EQ(draw.depth_func, DepthFunc::always);
    EXPECT_EQ(draw.material.shininess, 5);
  }
}

TEST_F(SceneFile, PatchesWhatItIncludes) {
  write(R"({"include": ["parts/room.part.json"], "frame": {"width": 8, "height": 9},
            "lights": [{"point": [0, 0, 0]}, {"point": [1, 0, 0]}]})",
        "group/common.part.json");
  write(R"({"frame": {"depth": "z16", "width": 5}, "ambient": [1, 1, 1],
            "projection": {"perspective": {"fov_y": 30, "near": 1, "far": 9}}})",
        "assets/parts/room.part.json");
  write(R"({"camera": {"eye": [0, 0, 7]}, "frame": {"height": 10}})", "group/later.part.json");
  const Scene s = load(R"({"$schema": "../scene.schema.json", "include": ["common.part.json", "later.part.json"],
      "description": "d", "frame": {"width": 7}, "lights": [{"directional": [0, 0, 1]}],
      "projection": {"perspective": null,
                     "frustum": {"left": -1, "right": 1, "bottom": -2, "top": 2, "near": 3, "far": 4}},
      "draws": [{"mesh": {"cube": {}}}]})");
  EXPECT_EQ(s.frame.width, 7);                 // the file's own
  EXPECT_EQ(s.frame.height, 10);               // of two includes the later's
  EXPECT_EQ(s.frame.depth, DepthFormat::z16);  // an include's include, from an asset folder
  EXPECT_EQ(s.light_model.ambient, glm::vec3(1));
  EXPECT_EQ(s.camera.eye, glm::dvec3(0, 0, 7));
  EXPECT_EQ(s.lights.size(), 1u);  // an array is replaced
  const auto& f = std::get<Frustum>(s.projection);
  EXPECT_EQ((std::array{f.left, f.right, f.bottom, f.top, f.near, f.far}), (std::array{-1., 1., -2., 2., 3., 4.}));
}

TEST_F(SceneFile, FollowsNamesThatEndWithinAFolder) {
  write("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "group/own.obj");
  write("v 0 0 0\nv 3 0 0\nv 0 3 0\nf 1 2 3\n", "assets/shared.obj");
  fs::create_directories(root_ / "group/parts");
  fs::create_symlink("../own.obj", root_ / "group/parts/link.obj");
  const Scene s = load(R"({"description": "d", "draws": [{"mesh": {"file": "parts/link.obj"}},
      {"mesh": {"file": "parts/../own.obj"}}, {"mesh": {"file": "../assets/shared.obj"}}]})");
  EXPECT_EQ(s.meshes[0].positions, s.meshes[1].positions);
  EXPECT_EQ(s.meshes[2].positions[1].x, 3);
}

TEST_F(SceneFile, AFilesMaterialsCountUnlessTheSceneGivesOne) {
  write("newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n", "group/m.mtl");
  write("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 3 2 1\n", "group/two.obj");
  const Scene s = load(R"({"description": "d", "draws": [
      {"mesh": {"file": "two.obj"}, "cull": "back"}, {"mesh": {"cube": {}}},
      {"mesh": {"file": "two.obj"}, "material": {"shininess": 3}}]})");
  EXPECT_EQ(s.meshes.size(), 3u);
  ASSERT_EQ(s.draws.size(), 5u);
  EXPECT_EQ(s.draws[0].material.diffuse, glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(s.draws[1].material.diffuse, glm::vec4(0, 0, 1, 1));
  EXPECT_EQ(s.draws[1].cull, Cull::back);
  EXPECT_EQ(s.draws[2].material.diffuse, Material{}.diffuse);
  for (int i : {3, 4}) {
    EXPECT_EQ(s.draws[static_cast<std::size_t>(i)].mesh, s.draws[static_cast<std::size_t>(i - 3)].mesh);
    EXPECT_EQ(s.draws[static_cast<std::size_t>(i)].material.diffuse, Material{}.diffuse);
    EXPECT_EQ(s.draws[static_cast<std::size_t>(i)].material.shininess, 3);
  }
}

TEST_F(SceneFile, ReadsEveryGenerator) {
  const Scene s = load(R"({"description": "d", "draws": [{"mesh": {"quad": {}}},
      {"mesh": {"quad": {"positions": [[0, 0, 0], [3, 0, 0], [1, 1, 0], [0, 3, 0]],
                         "colors": [[1, 0, 0, 1], [0, 1, 0, 1], [0, 0, 1, 1], [1, 1, 1, 1]]}}},
      {"mesh": {"quad": {"positions": [[3, 0, 0], [1, 1, 0], [0, 3, 0], [0, 0, 0]]}}},
      {"mesh": {"cube": {}}}, {"mesh": {"icosphere": {"subdivisions": 1}}},
      {"mesh": {"torus_knot": {"segments": 30, "sides": 4}}},
      {"mesh": {"torus_knot": {"p": 3, "q": 4, "tube": 0.05, "segments": 31, "sides": 4}}},
      {"mesh": {"revolution": {"profile": [[0, 0], [1, 0], [1, 1], [0, 1]], "steps": 4, "slices": 5}}}]})");
  std::vector<std::size_t> triangles;
  for (const Mesh& mesh : s.meshes) triangles.push_back(mesh.triangles.size());
  EXPECT_EQ(triangles, (std::vector<std::size_t>{2, 2, 2, 12, 80, 240, 248, 30}));
  for (int m : {0, 1, 2}) {  // counter-clockwise, arrowheads cut along the diagonal that lies within
    double area = 0;
    const Mesh& mesh = s.meshes[static_cast<std::size_t>(m)];
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      EXPECT_GT(glm::cross(b - a, c - a).z, 0);
      area += glm::cross(b - a, c - a).z / 2;
    }
    EXPECT_FLOAT_EQ(static_cast<float>(area), m == 0 ? 4 : 3);
  }
  EXPECT_EQ(s.meshes[1].colors[2], glm::vec4(0, 0, 1, 1));
}

TEST_F(SceneFile, FindsScenes) {
  const std::string good = "{}";
  const fs::path b = write(good, "group/b.json"), a = write(good, "group/a.json"), c = write(good, "group/deep/c.json");
  write("", "group/readme.txt");
  write("{}", "group/common.part.json");
  write("{}", "group/scene.schema.json");
  const auto find = [](std::vector<fs::path> paths) { return find_scenes(paths); };
  EXPECT_EQ(find({root_ / "group"}), (std::vector{a, b, c}));
  EXPECT_EQ(find({b, root_ / "group/deep"}), (std::vector{b, c}));
  const fs::path part = root_ / "group/common.part.json";
  EXPECT_EQ(find({b, part}), std::vector{b}) << "as by a shell's *.json";
  EXPECT_EQ(find({part}), std::vector{part}) << "whose loading says what it is";
  EXPECT_THROW(find({}), SceneError);
  EXPECT_THROW(find({root_ / "none"}), SceneError);
  fs::create_directories(root_ / "empty");
  EXPECT_THROW(find({root_ / "empty"}), SceneError);
}

}  // namespace
}  // namespace plumbline

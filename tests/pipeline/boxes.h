// Scenes and comparisons for the tests of the pipeline as a renderer.
#pragma once

#include <utility>

#include "capture/renderer.h"

namespace plumbline::testing_words {

inline constexpr std::pair<ColorFormat, DepthFormat> kFormats[] = {
    {ColorFormat::rgba8, DepthFormat::z24},    {ColorFormat::rgba8, DepthFormat::z16},
    {ColorFormat::rgba12, DepthFormat::z8},    {ColorFormat::rgba16, DepthFormat::z24},
    {ColorFormat::rgba32f, DepthFormat::z32f}, {ColorFormat::rgba32f, DepthFormat::z24}};

/// The stages that have records in boxes(): all but texture, merge and resolve.
inline StageSet stages_with_records() {
  return {Stage::matrices, Stage::vertex, Stage::light,      Stage::clip,  Stage::window,
          Stage::coverage, Stage::depth,  Stage::attributes, Stage::shade, Stage::visibility};
}
inline Request everything() {
  Request request;
  request.records = stages_with_records();
  return request;
}

/// A closed box of side 2, each corner with a normal along its diagonal and a colour of its own.
inline Mesh box() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    const glm::vec3 p(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    mesh.positions.push_back(p);
    mesh.normals.push_back(glm::normalize(p));
    mesh.colors.push_back(glm::vec4(p * 0.4f + 0.5f, 1));
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// Boxes cut by the near plane and the frame's sides, one beyond the far plane, lit and unlit, flat and smooth, culled
/// either way, under several depth functions; the frame not a multiple of the tile's side.
inline Scene boxes(ColorFormat color = ColorFormat::rgba8, DepthFormat depth = DepthFormat::z24) {
  Scene scene;
  scene.name = "boxes";
  scene.frame = {90, 70, color, depth, {0.125f, 0.25f, 0.375f, 0.625f}, 0.9999};
  scene.camera = {{0.5, 1, 4}, {0, 0, 0}, {0, 1, 0}};
  scene.projection = Perspective{60, 1, 30};
  scene.light_model.ambient = glm::vec3(0.2f);
  scene.lights = {{Light::Kind::directional, {1, 2, 3}, glm::vec3(0.1f), glm::vec3(0.7f), glm::vec3(0.5f)},
                  {Light::Kind::point, {-3, 1, 2}, glm::vec3(0), {0.2f, 0.5f, 0.9f}, glm::vec3(0.3f)}};
  scene.meshes = {box(), {}, box(), box()};
  scene.meshes[2].colors.clear();
  scene.meshes[3].triangles.resize(6);
  const auto add = [&](std::uint32_t mesh, std::vector<Transform> transforms, bool lit, Shading shading, Cull cull,
                       DepthFunc func) {
    Draw draw;
    draw.mesh = mesh;
    draw.transforms = std::move(transforms);
    draw.material.specular = {0.4f, 0.4f, 0.4f, 1};
    draw.material.shininess = 9;
    draw.lit = lit;
    draw.shading = shading;
    draw.cull = cull;
    draw.depth_func = func;
    scene.draws.push_back(draw);
  };
  add(0, {Rotate{30, {1, 2, 0}}}, true, Shading::gouraud, Cull::back, DepthFunc::less);
  add(2, {Translate{{-1.5, 0.5, 2.8}}, Rotate{20, {0, 1, 1}}}, true, Shading::flat, Cull::none, DepthFunc::less);
  add(1, {}, true, Shading::flat, Cull::none, DepthFunc::less);  // an empty mesh
  add(0, {Translate{{0, 0, -40}}}, false, Shading::gouraud, Cull::none, DepthFunc::less);
  add(0, {Translate{{2.5, -1, 0.5}}, Scale{{1, 1.5, 0.5}}}, false, Shading::flat, Cull::front, DepthFunc::less_equal);
  add(2, {Translate{{0.5, 0.8, -0.5}}, Scale{{1.5, 0.2, 1}}}, false, Shading::gouraud, Cull::back, DepthFunc::greater);
  add(3, {Rotate{30, {1, 2, 0}}}, false, Shading::gouraud, Cull::none, DepthFunc::equal);  // half of the first
  return scene;
}

}  // namespace plumbline::testing_words

// Scenes given in window coordinates: x, y [pixels], z [0, 1].
#pragma once

#include <vector>

#include "scene/scene.h"

namespace plumbline::test {

struct ThreeCorners {
  glm::vec3 a, b, c;
};

/// White triangles, unlit, in one draw, on black, through an orthographic projection. The corners are p_win; p_model is
/// (x, y, -z).
inline Scene window_scene(int width, int height, const std::vector<ThreeCorners>& triangles) {
  Scene scene;
  scene.name = "window";
  scene.frame.width = width;
  scene.frame.height = height;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  const double w = width, h = height;
  scene.projection = Orthographic{0, w, 0, h, 0, 1};
  Mesh mesh;
  for (const ThreeCorners& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3& p : {t.a, t.b, t.c}) mesh.positions.emplace_back(p.x, p.y, -p.z);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  scene.meshes = {mesh};
  Draw draw;
  draw.lit = false;
  draw.material.diffuse = glm::vec4(1);
  scene.draws = {draw};
  return scene;
}

}  // namespace plumbline::test

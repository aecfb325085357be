// Scenes in the window's coordinates, and the legal answers of the oracle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/oracle/oracle.h"
#include "scene/scene.h"

namespace plumbline::math {

inline constexpr int kSize = 32;

/// Triangles in the coordinates of a square window, with a depth for each corner, from black to white along x.
inline Scene window_scene(const std::vector<std::array<glm::vec3, 3>>& triangles, int size = kSize) {
  Scene scene;
  scene.name = "window";
  scene.frame.width = scene.frame.height = size;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, 1.0 * size, 0, 1.0 * size, 0, 1};
  Mesh mesh;
  for (const auto& t : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const glm::vec3 p : t) {
      mesh.positions.emplace_back(p.x, p.y, -p.z);
      mesh.colors.emplace_back(glm::vec3(p.x / static_cast<float>(size)), 1);
    }
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 0, 1));
  scene.meshes = {mesh};
  Draw draw;
  draw.lit = false;
  scene.draws = {draw};
  return scene;
}

inline Legal legal(const Scene& scene, const Conventions& conventions) {
  Request request;
  request.legal = true;
  request.conventions = conventions;
  return legal_by_boxes(scene, request);
}

/// Pixels of which it is open how many fragments they have.
inline std::size_t open_pixels(const Legal& of) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < of.certain.size(); ++i) out += of.certain.values()[i] != of.possible.values()[i] ? 1 : 0;
  return out;
}

}  // namespace plumbline::math

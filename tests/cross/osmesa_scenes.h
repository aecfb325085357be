// Small scenes of the osmesa tests, in pixels.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "capture/plane.h"
#include "scene/mesh/mesh_shapes.h"
#include "scene/scene.h"

namespace plumbline::test {

/// An empty scene in which model space is window space: x, y in pixels, and z_win = (1 - z) / 2.
inline Scene pixel_scene(int width, int height) {
  Scene scene;
  scene.name = "test/pixels";
  scene.frame.width = width;
  scene.frame.height = height;
  scene.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
  scene.projection = Orthographic{0, static_cast<double>(width), 0, static_cast<double>(height), -1, 1};
  return scene;
}

/// Adds a mesh and its draw, unlit.
inline Draw& add(Scene& scene, Mesh mesh, const glm::vec4& color = glm::vec4(1)) {
  Draw draw;
  draw.mesh = static_cast<std::uint32_t>(scene.meshes.size());
  draw.lit = false;
  draw.material.diffuse = color;
  scene.meshes.push_back(std::move(mesh));
  scene.draws.push_back(draw);
  return scene.draws.back();
}

inline Mesh triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) { return make_triangles({a, b, c}, {{0, 1, 2}}, {}); }

/// Two triangles, counter-clockwise.
inline Mesh rectangle(float x0, float y0, float x1, float y1, float z) {
  return make_triangles({{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}}, {{0, 1, 2}, {0, 2, 3}}, {});
}

/// A plane as lines of text, the top row first: '.' for `background`, else the value's last digit.
template <class T>
std::vector<std::string> picture(const Plane<T>& plane, T background) {
  std::vector<std::string> rows;
  for (int y = plane.height() - 1; y >= 0; --y) {
    std::string row;
    for (int x = 0; x < plane.width(); ++x) {
      row += plane(x, y) == background ? '.' : static_cast<char>('0' + plane(x, y) % 10);
    }
    rows.push_back(row);
  }
  return rows;
}
using Picture = std::vector<std::string>;

}  // namespace plumbline::test

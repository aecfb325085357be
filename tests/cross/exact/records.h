// Hand-made scenes and records for the tests of the exact reference.
#pragma once

#include <array>
#include <initializer_list>

#include "reference/exact/exact.h"
#include "reference/exact/window.h"

namespace plumbline {

/// An empty frame; `primitives` triangles without vertices, drawn by one draw of each depth function given.
inline Scene scene_of(int width, int height, std::uint32_t primitives = 1,
                      std::initializer_list<DepthFunc> draws = {DepthFunc::less}) {
  Scene scene;
  scene.name = "test";
  scene.frame.width = width;
  scene.frame.height = height;
  scene.meshes.resize(1);
  scene.meshes[0].triangles.resize(primitives, glm::uvec3(0));
  for (DepthFunc func : draws) {
    scene.draws.emplace_back();
    scene.draws.back().depth_func = func;
  }
  return scene;
}

/// A window triangle through positions in pixels and window z, snapped and faced as stage 4 does.
inline WindowTriangle<double> window_triangle(const std::array<glm::dvec3, 3>& p_win, std::uint32_t primitive = 0) {
  WindowTriangle<double> triangle{};
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.v[i].p_win = p_win[i];
    triangle.v[i].inv_w = 1;
    triangle.v[i].snapped = exact::snap(glm::dvec2(p_win[i]));
  }
  triangle.primitive = primitive;
  triangle.front = exact::facing(exact::snapped_corners(triangle)) > 0;
  return triangle;
}

/// A window triangle of snapped corners alone, faced by them.
inline WindowTriangle<double> snapped_triangle(const std::array<glm::ivec2, 3>& corners, std::uint32_t primitive = 0) {
  WindowTriangle<double> triangle{};
  for (std::size_t i = 0; i < 3; ++i) triangle.v[i].snapped = corners[i];
  triangle.primitive = primitive;
  triangle.front = exact::facing(corners) > 0;
  return triangle;
}

inline Capture run(const Scene& scene, Stage stage, const Records<double>& records) {
  Capture in;
  in.records = records;
  return exact::make_exact()->run_stage(scene, stage, in);
}

}  // namespace plumbline

// Window triangles made by hand, for the tests of the stages that take them.
#pragma once

#include <array>

#include "capture/stages.h"
#include "pipeline/window.h"

namespace plumbline::testing_words {

inline WindowVertex<float> window_vertex(glm::vec3 p_win, float w_clip = 1, glm::vec4 color = glm::vec4(1)) {
  return {p_win, 1.0f / w_clip, {pipeline::snap(p_win.x), pipeline::snap(p_win.y)}, color};
}

/// Faced by its snapped corners.
inline WindowTriangle<float> window_triangle(const WindowVertex<float>& a, const WindowVertex<float>& b,
                                             const WindowVertex<float>& c, std::uint32_t primitive = 0) {
  WindowTriangle<float> triangle{{a, b, c}, primitive, false};
  triangle.front = pipeline::snapped_area(triangle) > 0;
  return triangle;
}
inline WindowTriangle<float> window_triangle(glm::vec2 a, glm::vec2 b, glm::vec2 c, float z = 0.5f) {
  return window_triangle(window_vertex({a, z}), window_vertex({b, z}), window_vertex({c, z}));
}

/// By snapped corners (pixel i's centre is 256 i); the unsnapped ones are the same points.
inline WindowTriangle<float> snapped_triangle(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  WindowTriangle<float> triangle{};
  const glm::ivec2 corner[] = {a, b, c};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 p = glm::dvec2(corner[i]) / 256.0 + 0.5;
    triangle.v[i] = {glm::vec3(glm::vec2(p), 0.5f), 1, corner[i], glm::vec4(1)};
  }
  triangle.front = pipeline::snapped_area(triangle) > 0;
  return triangle;
}

}  // namespace plumbline::testing_words

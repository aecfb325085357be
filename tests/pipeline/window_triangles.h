// Window triangles made by hand, for the tests of the stages that take them.
#pragma once

#include <array>

#include "pipeline/stages.h"

namespace plumbline::testing_words {

struct ShadedVertex : pipeline::WindowVertex {
  glm::vec4 color;
};
inline ShadedVertex window_vertex(glm::vec3 p_win, float w_clip = 1, glm::vec4 color = glm::vec4(1)) {
  return {{p_win, 1.0f / w_clip, {pipeline::snap(p_win.x), pipeline::snap(p_win.y)}}, color};
}

/// A triangle, line or point of 3, 2 or 1 corners; `front` is true whatever the winding.
inline pipeline::ShadedTriangle window_primitive(const ShadedVertex& a, const ShadedVertex& b, const ShadedVertex& c,
                                                 std::uint32_t primitive = 0, std::uint32_t corners = 3) {
  pipeline::ShadedTriangle out{{{a, b, c}, primitive, true, corners}, {}};
  out.attributes[0].color() = a.color, out.attributes[1].color() = b.color, out.attributes[2].color() = c.color;
  return out;
}
/// A triangle faced by its snapped corners.
inline pipeline::ShadedTriangle window_triangle(const ShadedVertex& a, const ShadedVertex& b, const ShadedVertex& c,
                                                std::uint32_t primitive = 0) {
  pipeline::ShadedTriangle triangle = window_primitive(a, b, c, primitive);
  triangle.front = pipeline::snapped_area(triangle) > 0;
  return triangle;
}
inline pipeline::ShadedTriangle window_triangle(glm::vec2 a, glm::vec2 b, glm::vec2 c, float z = 0.5f) {
  return window_triangle(window_vertex({a, z}), window_vertex({b, z}), window_vertex({c, z}));
}

/// A triangle by snapped corners [1/256 pixel; pixel i's centre is 256 i]; the unsnapped ones are the same points.
/// Depth 1/2, w 1, white.
inline pipeline::ShadedTriangle snapped_triangle(glm::ivec2 a, glm::ivec2 b, glm::ivec2 c) {
  const auto vertex = [](glm::ivec2 snapped) {
    const glm::dvec2 p = glm::dvec2(snapped) / 256.0 + 0.5;
    return ShadedVertex{{glm::vec3(glm::vec2(p), 0.5f), 1, snapped}, glm::vec4(1)};
  };
  return window_triangle(vertex(a), vertex(b), vertex(c));
}

inline pipeline::AttributeSetup color_setup(const pipeline::ShadedTriangle& t) {
  return pipeline::attribute_setup({t.attributes[0].color(), t.attributes[1].color(), t.attributes[2].color()});
}

}  // namespace plumbline::testing_words

// Lines and the pixels that they cover, as two renderers may hand them out.
#pragma once

#include "tests/check/fixtures.h"

namespace plumbline::check {

using Pixels = std::vector<glm::ivec2>;

inline WindowTriangle<double> line_of(glm::dvec2 a, glm::dvec2 b, std::uint32_t primitive = 0) {
  WindowTriangle<double> t =
      triangle_of({glm::dvec3(a, 0.25), glm::dvec3(b, 0.75), glm::dvec3(b, 0.75)}, {1, 1, 1}, primitive);
  t.v[2].color = t.v[1].color;
  t.front = true;
  t.corners = 2;
  return t;
}

/// Capture of a 16 x 12 frame: `others`, the pixels of primitive 9, and over them line i at pixels[i]. Only the lines
/// have records.
inline Capture drawn(const std::vector<WindowTriangle<double>>& lines, const std::vector<Pixels>& pixels,
                     const Pixels& others = {}) {
  Capture c;
  c.records.triangles = lines;
  c.planes.count = Plane<std::uint32_t>(16, 12);
  c.planes.id_sum = Plane<std::uint64_t>(16, 12);
  c.planes.id = Plane<std::int32_t>(16, 12, kBackground);
  c.planes.depth = Plane<double>(16, 12, 1);
  const auto add = [&](glm::ivec2 p, std::uint32_t primitive) {
    ++c.planes.count(p.x, p.y);
    c.planes.id_sum(p.x, p.y) += id_weight(primitive);
    c.planes.id(p.x, p.y) = static_cast<std::int32_t>(primitive);
  };
  for (const glm::ivec2 p : others) add(p, 9);
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    for (const glm::ivec2 p : pixels[i]) {
      c.records.covered.push_back({i, static_cast<std::uint16_t>(p.x), static_cast<std::uint16_t>(p.y)});
      add(p, lines[i].primitive);
    }
  }
  return c;
}

}  // namespace plumbline::check

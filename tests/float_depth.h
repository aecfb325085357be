// Depths in float, in the ways that renderers interpolate them (capture/float_depth.h).
#pragma once

#include <array>

#include "capture/float_depth.h"

namespace plumbline::test {

enum class FloatDepth { none, edge_functions, plane, edge_equations };

/// Depth at p [pixels]; NaN or infinite where the area is 0 in float. `way`: not none.
inline float depth_in_float(FloatDepth way, const WindowCorners& corners, const glm::vec2& p) {
  const std::array<glm::vec3, 3> v = {glm::vec3(corners[0]), glm::vec3(corners[1]), glm::vec3(corners[2])};
  const auto cross = [](const glm::vec2& a, const glm::vec2& b) { return a.x * b.y - a.y * b.x; };
  const glm::vec2 e1 = glm::vec2(v[1]) - glm::vec2(v[0]), e2 = glm::vec2(v[2]) - glm::vec2(v[0]);
  const float area = cross(e1, e2);
  if (way == FloatDepth::edge_functions) {
    float z = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec2 from(v[(i + 1) % 3]), to(v[(i + 2) % 3]);
      z += cross(to - from, p - from) / area * v[i].z;
    }
    return z;
  }
  if (way == FloatDepth::plane) {
    const float z1 = v[1].z - v[0].z, z2 = v[2].z - v[0].z;
    const float d_dx = (z1 * e2.y - z2 * e1.y) / area, d_dy = (z2 * e1.x - z1 * e2.x) / area;
    const float at_origin = v[0].z - d_dx * v[0].x - d_dy * v[0].y;
    return at_origin + d_dx * p.x + d_dy * p.y;
  }
  glm::vec3 plane(0);
  float sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::vec3 &from = v[(i + 1) % 3], &to = v[(i + 2) % 3];
    const float a = from.y - to.y, b = to.x - from.x, c = -(a * (from.x + to.x) + b * (from.y + to.y)) / 2;
    plane += v[i].z * glm::vec3(a, b, c);
    sum += c;
  }
  plane /= sum;
  return plane.x * p.x + plane.y * p.y + plane.z;
}

}  // namespace plumbline::test

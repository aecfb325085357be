// Area of a triangle in window space, of its unsnapped or its snapped corners.
#pragma once

#include <glm/glm.hpp>

#include "capture/stages.h"

namespace plumbline::check {

inline constexpr auto kUnsnapped = [](const WindowVertex<double>& v) { return glm::dvec2(v.p_win); };
inline constexpr auto kSnapped = [](const WindowVertex<double>& v) { return glm::dvec2(v.snapped); };

/// Twice the signed area of the corners' positions, by kUnsnapped [pixel^2] or by kSnapped [(1/256 pixel)^2]. Positive:
/// counter-clockwise with y up.
template <class Place>
double twice_area(const WindowTriangle<double>& t, Place place) {
  const glm::dvec2 a = place(t.v[0]), b = place(t.v[1]) - a, c = place(t.v[2]) - a;
  return b.x * c.y - b.y * c.x;
}

}  // namespace plumbline::check

// Where a ray crosses a triangle.
#pragma once

#include <array>
#include <optional>

#include "image_order/rays.h"

namespace plumbline::image_order {

struct Crossing {
  double along;  ///< distance along the view; negative behind the eye
  bool front;    ///< the triangle is counter-clockwise in (Seen::x, Seen::y)
};

/// Crossing of the ray and the triangle (world space); nothing where the ray passes by, or lies in the triangle's
/// plane.
///
/// The weights of Moeller and Trumbore (1997), each by the two corners of an edge alone, as Woop, Benthin and Wald
/// ("Watertight ray/triangle intersection", 2013) have it: a corner's position relative to the ray is rounded once,
/// alike for all triangles that share the corner, and the sign of a weight is exact from there on. A ray through an
/// edge or a corner counts as moved by e in x and e^2 in y, e infinitely small (stages.h, tie rule left_bottom): it
/// crosses one of the triangles that meet there, whatever was rounded.
std::optional<Crossing> crossing(const Ray& ray, const std::array<glm::dvec3, 3>& triangle);

}  // namespace plumbline::image_order

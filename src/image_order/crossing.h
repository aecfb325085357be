// Where a ray crosses a triangle.
#pragma once

#include <array>
#include <optional>

#include "image_order/rays.h"

namespace plumbline::image_order {

struct Crossing {
  double along;  ///< the view; negative behind the eye
  bool front;    ///< the triangle is counter-clockwise, seen from there
};

/// Nothing where the ray passes by, or runs in the triangle's own plane.
///
/// The weights of Moeller and Trumbore (1997), each by the two corners of an edge alone, as Woop, Benthin and Wald
/// ("Watertight ray/triangle intersection", 2013) have it: a corner's place beside the ray is rounded once, the same
/// for all triangles that it is a corner of, and the sign of a weight is exact from there on. A ray through an edge or
/// a corner is moved a hair to the right, and by a hair of that up (stages.h, TieRule::small_sides_in): it crosses one
/// of the triangles that meet there, whatever was rounded.
std::optional<Crossing> crossing(const Ray& ray, const std::array<glm::dvec3, 3>& triangle);

}  // namespace plumbline::image_order

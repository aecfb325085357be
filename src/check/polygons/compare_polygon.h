// Comparator of two clip polygons of one primitive.
#pragma once

#include <cstdint>
#include <span>

#include "check/polygons/legal_polygon.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

using Vertices = std::span<const ClipVertex<double>>;

/// A primitive whose polygons are compared, and the errors that its vertices may have.
struct ComparedPrimitive {
  std::uint32_t number = 0;
  Corners corners{};
  double factor = 0;     ///< error of a cut vertex [u of corners.scale, or of corners.color_scale]
  double copies = 0;     ///< error of a vertex of the mesh [likewise]
  bool is_flat = false;  ///< a triangle without area, of which a foreign clipper may keep any polygon, or none

  /// Error of a cut vertex in clip space.
  double reach() const;
  Place at(const char* field) const { return {-1, -1, number, field, true}; }
};

/// Whether it is certain which clip planes cut a primitive, or rounding decides about some.
enum class Cuts { certain, open };

/// Holds a vertex to the plane of its triangle and to the inside of the view volume, but for rounding. The triangle's
/// edges are not checked.
void within_triangle(Meter& meter, const ClipVertex<double>& v, const ComparedPrimitive& primitive);

/// Holds each vertex to within_triangle(), a cut vertex also to a clip plane (and, unless on two planes, to an edge),
/// any other vertex to a corner of the triangle.
void within_rounding(Meter& meter, Vertices polygon, const ComparedPrimitive& primitive);

/// Compares two polygons of the primitive. Cuts::open: a vertex on a plane whose cut rounding decides is held by
/// within_rounding() alone, not to a counterpart.
void compare_polygon(Meter& meter, Vertices mine, Vertices theirs, const ComparedPrimitive& primitive, Cuts cuts);

}  // namespace plumbline::check

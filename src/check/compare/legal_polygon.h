// Legal outcomes of stage 3 for one primitive, by its corners (records of the stages before): what rounding leaves of
// it lies between the triangle cut by planes moved inwards and by planes moved outwards.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "capture/stages.h"

namespace plumbline::check {

/// A primitive as it is cut; a line's last corner stands twice.
struct Corners {
  std::array<Vec4<double>, 3> p_clip, color;
  double scale;        ///< the largest coordinate
  double color_scale;  ///< the largest channel, at least 1: varyings are of any size
  std::size_t planes;  ///< that cut: the sides alone where depth is clamped
};

/// Signed distances, in units of w, to right, left, top, bottom, near, far.
std::array<double, 6> distances(const Vec4<double>& p);
bool on_plane(const ClipVertex<double>& v, std::size_t plane, double tolerance);

/// Whether all corners are inside every plane, or all outside one plane. Rounding leaves neither open: w - x of two
/// floats, rounded to float, keeps its sign.
bool uncut(const Corners& c);

/// Rest of the triangle where all planes are moved inwards by `by`, by Sutherland and Hodgman in double.
std::vector<ClipVertex<double>> clipped(const Corners& c, double by);

/// Whether a polygon reaches no farther than rounding into the inside of one of the first `planes`: it may be there or
/// not.
bool may_vanish(std::span<const ClipVertex<double>> polygon, std::size_t planes, double tolerance);

/// Whether rounding decides if end `i` of a line is cut off, and `v` is what the line may end in: the corner itself, or
/// a place on a plane that the corner lies on.
bool may_end_in(const ClipVertex<double>& v, const Corners& c, std::size_t i, double tolerance);

/// From a point in clip space to a convex polygon; infinite where that has no vertices.
double distance_to_polygon(const Vec4<double>& p, std::span<const ClipVertex<double>> polygon);

}  // namespace plumbline::check

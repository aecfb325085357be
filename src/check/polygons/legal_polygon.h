// Legal outcomes of stage 3 (clip) for one primitive, from its corners (records of earlier stages): any polygon between
// the primitive cut by clip planes moved inwards and cut by planes moved outwards, both by the rounding error.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "capture/stages.h"

namespace plumbline::check {

/// A primitive before clipping; a line's last corner stands twice.
struct Corners {
  std::array<Vec4<double>, 3> p_clip, color;
  double scale;        ///< the largest coordinate
  double color_scale;  ///< the largest channel, at least 1: varyings are of any size
  std::size_t planes;  ///< clip planes in use: 6; where depth is clamped the 4 sides
};

/// Signed distances of a clip position from the planes right, left, top, bottom, near, far [w]; positive inside.
std::array<double, 6> distances(const Vec4<double>& p);
/// Whether the vertex is within `tolerance` [w] of clip plane `plane`, numbered as in distances().
bool on_plane(const ClipVertex<double>& v, std::size_t plane, double tolerance);

/// Whether all corners are inside every plane, or all outside one plane. Rounding cannot change either: the difference
/// w - x of two floats, rounded to float, keeps its sign.
bool needs_no_cut(const Corners& c);

/// The polygon clipped by one plane, of distances(), moved inwards by `by` [w], by Sutherland-Hodgman in double.
std::vector<ClipVertex<double>> cut_by(std::span<const ClipVertex<double>> polygon, std::size_t plane, double by);
/// The triangle clipped by planes moved inwards by `by` (negative: outwards) [w], by Sutherland-Hodgman in double.
std::vector<ClipVertex<double>> clipped(const Corners& c, double by);

/// Whether rounding decides if anything is left of a polygon: all vertices are at most `tolerance` inside one of the
/// first `planes` clip planes. False for an empty polygon.
bool may_vanish(std::span<const ClipVertex<double>> polygon, std::size_t planes, double tolerance);

/// True: the corners of a triangle lie on one line of clip space, but for `tolerance`. Such a triangle covers nothing.
bool is_flat(const Corners& c, double tolerance);

/// Whether rounding decides if end `i` of a line is cut off, and `v` is a legal end: the corner itself, or a cut vertex
/// on a clip plane that the corner lies on.
bool may_end_in(const ClipVertex<double>& v, const Corners& c, std::size_t i, double tolerance);

/// Distance in clip space of a point from a convex polygon; infinite for a polygon without vertices.
double distance_to_polygon(const Vec4<double>& p, std::span<const ClipVertex<double>> polygon);

}  // namespace plumbline::check

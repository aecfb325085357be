// Legal outcomes of stage 3 (clip) for one primitive, from its corners (records of earlier stages): any polygon between
// the primitive cut by clip planes moved inwards and cut by planes moved outwards, both by the rounding error; and the
// distances of clipped vertices that tell it.
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

// Vertex as a point of eight coordinates: the position divided by Corners::scale, the colour divided by
// Corners::color_scale. Distances below are between such points. Where a coordinate is not finite, distances by the
// largest coordinate are infinite, and distance_between() is infinite or NaN.

/// Largest difference of a coordinate.
double largest_difference(const ClipVertex<double>& a, const ClipVertex<double>& b, const Corners& c);

/// Euclidean distance.
double distance_between(const ClipVertex<double>& a, const ClipVertex<double>& b, const Corners& c);

/// Point of the line through `a` and `b` that is nearest to `v`. `share`: the point's position, 0 at `a` and 1 at `b`.
/// `distance`: largest coordinate of the difference between `v` and the point. Where `a` and `b` coincide: share 0,
/// distance from `a`.
struct AlongLine {
  double share, distance;
};
AlongLine nearest_on_line(const ClipVertex<double>& v, const ClipVertex<double>& a, const ClipVertex<double>& b,
                          const Corners& c);

/// Largest coordinate of the difference between `v` and its projection onto the plane of the triangle.
double distance_from_triangle(const ClipVertex<double>& v, const Corners& c);

/// Distance of `v`, by the largest coordinate, from the line through corners `i` and (i + 1) % 3; and from the nearest
/// of the three such lines.
double distance_from_edge(const ClipVertex<double>& v, const Corners& c, std::size_t i);
double distance_from_edges(const ClipVertex<double>& v, const Corners& c);

}  // namespace plumbline::check

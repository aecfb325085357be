// Distances of clipped vertices from each other and from the triangle that they were cut from.
#pragma once

#include <cstddef>

#include "check/polygons/legal_polygon.h"

namespace plumbline::check {

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
AlongLine along_line(const ClipVertex<double>& v, const ClipVertex<double>& a, const ClipVertex<double>& b,
                     const Corners& c);

/// Largest coordinate of the difference between `v` and its projection onto the plane of the triangle.
double distance_from_triangle(const ClipVertex<double>& v, const Corners& c);

/// Distance of `v`, by the largest coordinate, from the line through corners `i` and (i + 1) % 3; and from the nearest
/// of the three such lines.
double distance_from_edge(const ClipVertex<double>& v, const Corners& c, std::size_t i);
double distance_from_edges(const ClipVertex<double>& v, const Corners& c);

}  // namespace plumbline::check

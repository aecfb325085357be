// Distances of clipped vertices from each other and from the triangle that they were cut from.
#pragma once

#include <cstddef>

#include "check/compare/legal_polygon.h"

namespace plumbline::check {

// Position and colour count as one place of eight coordinates: the position over Corners::scale, the colour over
// Corners::color_scale. Distances are in these units; infinite where a coordinate is not finite.

/// Largest difference of a coordinate.
double largest_difference(const ClipVertex<double>& a, const ClipVertex<double>& b, const Corners& c);

/// Euclidean distance.
double distance_between(const ClipVertex<double>& a, const ClipVertex<double>& b, const Corners& c);

/// How far along the way from `a` to `b` the nearest place to `v` is, 0 at `a` and 1 at `b`, and the distance from it,
/// largest coordinate; of two vertices in one place 0, and the distance from `a`.
struct AlongLine {
  double share, distance;
};
AlongLine along_line(const ClipVertex<double>& v, const ClipVertex<double>& a, const ClipVertex<double>& b,
                     const Corners& c);

/// Distance from the plane of the triangle: largest coordinate.
double distance_from_triangle(const ClipVertex<double>& v, const Corners& c);

/// Distance from the line through corners `i` and (i + 1) % 3, and from the nearest of the three: largest coordinate.
double distance_from_edge(const ClipVertex<double>& v, const Corners& c, std::size_t i);
double distance_from_edges(const ClipVertex<double>& v, const Corners& c);

}  // namespace plumbline::check

// Several polygons of one primitive as one: a clipper may leave triangles, or cut each of them again.
#pragma once

#include <span>
#include <vector>

#include "check/polygons/legal_polygon.h"

namespace plumbline::check {

/// Polygon of the edges that only one of the parts has; empty where these edges form no single closed polygon. Edges
/// are split at vertices that lie on them; edges of two parts that run opposite ways cancel. Vertices are the same if
/// no coordinate is more than `tolerance` apart (legal_polygon.h). A vertex made by a cut is left out where the vertex
/// and both neighbours lie within `tolerance` times Corners::scale of one clip plane.
std::vector<ClipVertex<double>> join_polygons(std::span<const std::span<const ClipVertex<double>>> parts,
                                              const Corners& corners, double tolerance);

}  // namespace plumbline::check

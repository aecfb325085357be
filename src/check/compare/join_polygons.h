// Several polygons of one primitive as one: a clipper may leave triangles, or cut each of them again.
#pragma once

#include <span>
#include <vector>

#include "check/compare/legal_polygon.h"

namespace plumbline::check {

/// The polygon of the edges that only one of the parts has; empty where they are not the edges of one. Edges of two parts
/// cancel if they run opposite ways, and so do parts of edges on which a vertex lies. Vertices are the same if no
/// coordinate is more than `tolerance` apart (clip_distances.h). A vertex made by a cut is left out where it and both its
/// neighbours are at most `tolerance` times the scale from one clip plane: it is no corner of the polygon.
std::vector<ClipVertex<double>> join_polygons(std::span<const std::span<const ClipVertex<double>>> parts,
                                              const Corners& corners, double tolerance);

}  // namespace plumbline::check

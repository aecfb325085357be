// Coverage of a triangle by the four algorithms of the notes (the renderer's: kernels/coverage.h). Each has its own
// expression, in integers, and shares no predicate with another: each checks the others.
//
// Corners are snapped to 1/256 pixel, pixel (i, j)'s centre is at (256 i, 256 j), y counts up. A centre inside is
// covered; a centre on an edge where the interior lies to the right (+x), or above (+y) a horizontal edge (stages.h,
// tie rule left_bottom). Each algorithm has its own form of that rule. Both windings cover the same
// pixels; a triangle without area covers none.
//
// All four return the covered pixels of a width x height frame, ascending in y, then x. They throw std::out_of_range
// for corners beyond +-2^29 (2 million pixels) and frame sides beyond [1, 16384].
#pragma once

#include "notes/raster/triangle_spans.h"

namespace plumbline::raster {

/// Barycentric coordinates alpha, beta, gamma by f_ij, over the bounding box (note 000, Rasterization).
Spans cover_by_barycentric(const Corners& corners, int width, int height);

/// The sign of three cross products, the same for a point inside (note 001, "Evaluating inside(tri, x, y)").
Spans cover_by_cross_products(const Corners& corners, int width, int height);

/// Linear expression evaluation: E(x, y) = dY (x - X) - dX (y - Y) of each edge, stepped from pixel to pixel by one
/// addition (note 004, section 2.5).
Spans cover_by_lee(const Corners& corners, int width, int height);

/// Scan line: each row's span from edge to edge (note 004, section 2.4, object order).
Spans cover_by_scan_line(const Corners& corners, int width, int height);

}  // namespace plumbline::raster

// Stage 4: polygons are divided by w, moved to the window, split into triangles, snapped and faced.
#pragma once

#include <vector>

#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// Appends a polygon's fan of triangles, corners (i-1, i, 0); a line or point as it is; of a polygon that the draw does
/// not fill, its edges or corners (capture/stages.h). Where the draw is lit from two sides, back faces have the back's
/// colours. Dropped: triangles of zero snapped area, those that the draw culls, and those of a polygon with a corner of
/// w = 0 or more than 2^20 pixels away.
///
/// p_win = p_ndc * scale + translate, fused for vertices of the mesh and not for cut ones, as the driver of the vertex
/// recipe (vertex.h) does.
void to_window(const DrawInput& input, const Polygon& polygon, std::vector<ShadedTriangle>& out);

}  // namespace plumbline::pipeline

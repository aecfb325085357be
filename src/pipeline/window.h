// Stage 4: polygons are divided by w, moved to the window, split into triangles, snapped and faced.
#pragma once

#include <span>
#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// (win - 1/2) * 256, rounded half to even: pixel i's centre is 256 i.
int snap(float win);

/// Twice the snapped area, in 1/65536 pixel; > 0: counter-clockwise in the window, a front face.
std::int64_t snapped_area(const WindowTriangle<float>& triangle);

/// Appends each polygon's fan of triangles, corners (i-1, i, 0); lines and points as they are; of a polygon that the
/// draw does not fill, its edges or corners (stages.h). Dropped: triangles of zero snapped area, those that the draw
/// culls, and those of a polygon with a corner of w = 0 or more than 2^20 pixels away.
///
/// p_win = p_ndc * scale + translate, fused for vertices of the mesh and not for cut ones, as the driver of the vertex
/// recipe (vertex.h) does.
void to_window(const Matrices<float>& matrices, const Draw& draw, const ClipPolygons<float>& polygons,
               std::span<const ClipPolygon> of_draw, std::vector<WindowTriangle<float>>& out);

}  // namespace plumbline::pipeline

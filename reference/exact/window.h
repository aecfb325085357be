// Stage 4: polygons are divided by w and moved to the window in double; snapping, fans and facing are in integers.
#pragma once

#include <array>
#include <vector>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// round_half_even((p_win - 1/2) * 256): pixel (i, j)'s centre is (256 i, 256 j).
glm::ivec2 snap(glm::dvec2 p_win);

/// Sign of the snapped corners' area: 1 counter-clockwise (front), -1 clockwise, 0 without area.
int facing(const std::array<glm::ivec2, 3>& snapped);

/// The corners' snapped positions.
std::array<glm::ivec2, 3> snapped_corners(const WindowTriangle<double>& triangle);

/// Stage 4: for each polygon a fan of triangles, without those culled or without snapped area; edges or corners of
/// polygons that are not filled. Lines and points face the front and are not culled. A polygon is dropped as a whole if
/// a corner has w <= 0, or a window position that is not finite or beyond 2^31 / 256 pixels. Throws
/// std::invalid_argument where the records do not fit the scene or each other.
std::vector<WindowTriangle<double>> window_triangles(const Scene& scene, const ClipPolygons<double>& polygons,
                                                     const std::vector<Matrices<double>>& matrices);

}  // namespace plumbline::exact

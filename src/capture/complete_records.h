// Records as a program left them, in the order and with the columns that stages.h has.
#pragma once

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline {

/// Puts records in order, where their order says nothing: polygons and window triangles by primitive, fragments by
/// triangle, row and column; a triangle's corners so that its polygon's first is the last. Fills the columns of `capture.derived`: vertex.n_eye by the draw's normal matrix;
/// clip.cut where no corner of the primitive has this position; window.snapped by the rounding of p_win; window.front by
/// the snapped area; window.corners and window.width by the mesh and the draw. Throws std::invalid_argument, naming the
/// column, of window.front and window.corners where a draw's polygons are not filled. `capture`: of primitives and draws
/// that the scene has; fragments of triangles that are there.
void complete_records(const Scene& scene, Capture& capture);

}  // namespace plumbline

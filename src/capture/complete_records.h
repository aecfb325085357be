// Records as a program left them, in the order and with the columns that stages.h has.
#pragma once

#include "capture/capture.h"
#include "scene/scene.h"

namespace plumbline {

/// Sorts polygons and window triangles by primitive, those of one primitive as they are, and fragments by triangle, row
/// and column. Fills the columns of `capture.derived`, which is empty then: window.snapped by the rounding of p_win, window.front by the
/// snapped area, window.corners and window.width by the mesh and the draw. Throws std::invalid_argument, naming the
/// column and the record: of a primitive that the scene does not have, of a p_win that cannot be snapped, of front and
/// corners where a draw's polygons are not filled. Order of drawing shows in the frame, and is judged there.
void complete_records(const Scene& scene, Capture& capture);

}  // namespace plumbline

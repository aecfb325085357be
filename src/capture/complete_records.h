// Records as a program left them, in the order and with the columns that stages.h has.
#pragma once

#include "capture/capture.h"
#include "capture/conventions.h"
#include "scene/scene.h"

namespace plumbline {

/// Sorts polygons and window triangles by primitive, those of one primitive as they are, and fragments by triangle, row
/// and column. Order of drawing shows in the frame, and is judged there.
///
/// Fills the columns of `capture.derived`, which is empty then: vertex.n_eye by the capture's matrices and the mesh;
/// clip.cut by whether the corner's place is, in float, that of one of its primitive's vertices; window.snapped by
/// p_win and the conventions, window.front by the snapped area, window.corners and window.width by the mesh and the
/// draw.
///
/// Where planes.depth was read from floats, its values become those of the nearest codes.
///
/// Throws std::invalid_argument, naming the column and the record: of a primitive that the scene does not have, of
/// n_eye without matrices, of cut without vertices, of a p_win that cannot be snapped, of a position beyond 2^22 pixels or
/// a width beyond 64, of front and corners where a draw's polygons are not filled.
void complete_records(const Scene& scene, Capture& capture, const Conventions& conventions = {});

}  // namespace plumbline

// Records as a program left them, in the order and with the columns that stages.h has.
#pragma once

#include "capture/capture.h"
#include "capture/conventions.h"
#include "scene/scene.h"

namespace plumbline {

/// Depths whose floats are rounded to codes of the frame's format, or are left as they were read.
enum class Depths { of_codes, raw };

/// Sorts polygons and window triangles by primitive (stable), and fragments by triangle, row and column. The drawing
/// order is judged by the frame.
///
/// Fills the columns named in `capture.derived`, and clears that set. vertex.p_eye, n_eye: from the capture's matrices
/// and the mesh, NaN without matrices; where they are shown, the position varying of vertices (if 8 u of the terms tell
/// it from the matrices'), and of draws lit per fragment the normal varying. clip.cut: false where p_clip is that of a
/// vertex of the primitive, within 2^-22 of its largest coordinate (true where there are no vertices, and clip is not
/// judged). window.snapped: from p_win and the conventions; where a p_win lies beyond 2^22 pixels, records from window
/// on are cleared. window.front: by the sign of the area on the conventions' grid. Where the draw culls that face, and
/// the area is 0 on the grid or may have the other sign without snapping, it is the other face. window.corners,
/// window.width: from the mesh and the draw. texture.lod: NaN, as no recorded column determines it.
///
/// Rounds planes.depth to the nearest codes where it was read from f32, or is double's roundings (2^-50; of z8 and z16
/// float's, 2^-21) from a code, or where all of it are floats of codes; Depths::raw: only where it is roundings from a
/// code. (Of 24 bits, each float in [1/2, 1] is that of a code.) Rounds planes.depth to float where the format is z32f,
/// and depth.value to the nearest codes where all of it are floats of codes, under depth_rounding nearest. Varyings
/// that a draw does not carry become 0.
///
/// Throws std::invalid_argument, naming the column and the record: of a primitive that the scene does not have, of
/// n_eye where some draws' matrices are lacking, of cut where some vertices are lacking, of a p_win that is no number,
/// of a snapped position beyond 2^22 pixels, of a width beyond 64, of front and corners where a draw's polygons are not
/// filled.
void complete_records(const Scene& scene, Capture& capture, const Conventions& conventions = {},
                      Depths depths = Depths::of_codes);

}  // namespace plumbline

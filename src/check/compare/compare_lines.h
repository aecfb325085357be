// Comparators for a reference that draws lines by another rule than the diamond-exit rule, as OpenGL allows it to.
#pragma once

#include "capture/capture.h"
#include "check/compare/compare_planes.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Compares coverage of lines by the first three rules of OpenGL 2.1, section 3.4.1. Column: a line's pixels of one x
/// (y-major line: a row, of one y). Per line, on each side:
/// - a column of both sides: both ends at most `factor` pixels from the other side's; a pixel of any other column: at
///   most `factor` pixels, in x and in y, from the other side's nearest pixel;
/// - at most `factor` columns more or fewer than the other side;
/// - one pixel per column; of a wide line (3.4.2) a run of `width` pixels, which the frame or scissor box may cut.
/// Wide lines whose major axis snapping decides: only the nearest pixels are checked, with `width` pixels more.
/// Lines whose pixels differ are ambiguous. Everything else that covers a pixel must be equal.
Measurement compare_covered_lines(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor);

/// Compares winners and stencil values of scenes with lines or points. A difference is ambiguous where the two sides
/// cover the pixel with different primitives (coverage judges these), and where both sides' winners are legal by the
/// candidate's earlier records (open_pixels.h, LegalWinners).
Measurement compare_line_or_point_winners(const Scene& scene, const Capture& candidate, const Capture& reference,
                                          Stencils stencils = Stencils::compared);

}  // namespace plumbline::check

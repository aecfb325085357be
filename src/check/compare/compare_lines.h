// Comparators for a reference that draws lines by another rule than the diamond-exit rule, as OpenGL allows it to.
#pragma once

#include "capture/capture.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Coverage of lines by the first three rules of OpenGL 2.1, section 3.4.1, against the candidate's. Per line:
/// - each pixel is at most `factor` off, in x and y, from the candidate's in its column (y-major: row; or the nearest);
/// - at most `factor` columns more or fewer;
/// - one pixel per column; of a wide line (3.4.2) a run of `width` pixels, which the frame or scissor box may cut.
/// Where snapping decides the major axis of a wide line, only the first is checked, and `width` more is allowed.
/// Lines whose pixels differ are ambiguous. Everything else that covers a pixel must be equal.
Measurement compare_covered_lines(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor);

/// Winners, and stencil values, of scenes with lines or points. A difference is ambiguous where the two sides cover the
/// pixel with different primitives, which coverage judges, and where both are legal by the candidate's earlier records
/// (open_pixels.h, LegalWinners).
Measurement compare_line_or_point_winners(const Scene& scene, const Capture& candidate, const Capture& reference);

}  // namespace plumbline::check

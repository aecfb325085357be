// Comparators for a reference that draws lines by another rule than the diamond-exit rule, as OpenGL allows it to.
#pragma once

#include "capture/capture.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Coverage, by the rules that OpenGL 2.1, section 3.4.1, sets such lines. Of each line, against the candidate's: every
/// pixel at most `factor` off, in x and y, from the one in its column (x-major; else row) or, where there is none, from
/// the nearest; in number at most `factor` more or fewer; no two in one column. Of wide lines (3.4.2), what replaces a
/// pixel, a column of so many without a gap, takes its place; the frame, or its draw's scissor box, may cut it off.
/// The minor axis is open where snapping decides it. Lines that are not alike are counted as ambiguous.
/// All else that covers a pixel must be the same. The fourth rule, of lines that meet, is not looked at.
Measurement compare_covered_lines(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor);

/// Winners, and stencil values, of scenes with lines or points. Where the two sides cover a pixel with other
/// primitives, that is coverage's matter; where both sides' are legal by the candidate's earlier records
/// (open_pixels.h, LegalWinners), let them be: either is ambiguous.
Measurement compare_line_or_point_winners(const Scene& scene, const Capture& candidate, const Capture& reference);

}  // namespace plumbline::check

// Comparators of planes, stages 5 to 11: against another renderer's planes, and against an oracle's legal answers.
#pragma once

#include "capture/capture.h"
#include "capture/conventions.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Overdraw count and sum of weights, both with tolerance zero. A pixel is open where `legal` (empty: nowhere) allows
/// several counts, the candidate's among them. If a pixel that is not open differs, differences at open pixels are
/// ambiguous; if open pixels alone differ, they count as different.
Measurement compare_coverage(const Planes& candidate, const Planes& reference, const Legal& legal = {});

/// Winners against winners. Where they differ, `legal` decides (empty: nothing is ambiguous): both among the legal
/// answers: ambiguous; the reference alone outside: disputed; else different. Stencil values go with them.
Measurement compare_winners(const Planes& candidate, const Planes& reference, const Legal& legal);

/// Depth and colour where the winners are the same; the reference evaluates planes in float from the window's origin
/// (bounds.h): `factor` u of that magnitude, and for depth one step of the format, for colour what the two sides'
/// colours of the triangle's vertices differ by, which is light's matter. Along a line it may go by the major axis
/// (bounds.h): the nearer of the two values counts. Elsewhere as compare_winners.
Measurement compare_depth_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor);
Measurement compare_shaded_planes(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor);
/// rgba8 and rgba16, in codes: at most `codes` where the winners are the same, and the whole codes that the bound of
/// compare_shaded_planes comes to (slivers).
Measurement compare_codes(const Scene& scene, const Capture& candidate, const Capture& reference, double codes,
                          double factor);

/// Where colours are blended or masked, against a reference that does it in its own arithmetic (llvmpipe: in 8 bits):
/// at most `codes` per fragment drawn at the pixel (twice the former's more per fragment, where a factor reads the
/// frame), and what `factor` u of all their colours' bounds comes to; for rgba32f that alone, in u. Where it is open
/// which fragments made the colour, any number is legal. Codes that a logic op makes are equal where all fragments' own
/// codes, and the clear colour's that it reads, are certain and none was blended; else any is legal: a code's
/// difference of one may turn every bit.
Measurement compare_blended(const Scene& scene, const Capture& candidate, const Capture& reference, const Legal& legal,
                            double codes, double factor);

/// The candidate's planes against the colours that exact made of its own fragments: where it has codes, in half codes,
/// against unrounded colours; rgba32f and depth: equal. `bounds`: of colours that rounding on the way may have moved.
/// Codes are rounded, and stand for colours, as `conventions` say.
Measurement compare_merge(const Scene& scene, const Planes& candidate, const Planes& exact, double factor,
                          const Legal& bounds = {}, const Conventions& conventions = {});

/// Against legal answers. Pixels with more than one are counted as ambiguous. Depth and colour are held to the answer
/// of the pixel's own winner, `factor` times its bound; where that is not legal, it is visibility's matter alone. Where
/// the candidate shows no winners, each is held to the nearest of all answers. The depth of a pixel that only the clear
/// value may have is merge's, where there is a colour, too.
Measurement compare_legal_count(const Planes& candidate, const Legal& legal);
Measurement compare_legal_winner(const Planes& candidate, const Legal& legal);
Measurement compare_legal_depth(const Scene& scene, const Planes& candidate, const Legal& legal, double factor);
Measurement compare_legal_shaded(const Planes& candidate, const Legal& legal, double factor);
Measurement compare_legal_merge(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                const Conventions& conventions = {});

}  // namespace plumbline::check

// Comparators of planes, stages 5 to 11: against another renderer's planes, and against an oracle's legal answers.
#pragma once

#include <optional>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "check/compare/same_winners.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Compares overdraw counts and sums of weights (planes.count, planes.id_sum), tolerance 0; counts alone where the
/// candidate shows no sums. A pixel is open where
/// `legal` (empty: nowhere) allows several counts, the candidate's among them. If a pixel that is not open differs,
/// differences at open pixels are ambiguous; if open pixels alone differ, these pixels count as different.
Measurement compare_coverage(const Planes& candidate, const Planes& reference, const Legal& legal = {});

/// Compares winners and stencil values. A pixel that differs is ambiguous if both sides' values are a legal answer,
/// disputed if only the candidate's are, else different. `legal` empty: every difference counts.
Measurement compare_winners(const Planes& candidate, const Planes& reference, const Legal& legal,
                            Stencils stencils = Stencils::compared);

/// Compares depth or colour at the pixels where both sides have the same winner; compare_winners() judges the other
/// pixels. Tolerance: `factor` u of the magnitude of a plane that is evaluated in float from the window's origin
/// (bounds.h), plus one step of the format for depth, or FragmentBound::apart (fragment_bounds.h) for colour; 0 where
/// nothing is drawn. Along a line the reference may interpolate by the major axis (bounds.h): the nearer of the two
/// values counts. Where edges of an unfilled triangle meet, the reference may hold any edge's value (bounds.h,
/// EdgeValue).
Measurement compare_depth_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor);
Measurement compare_shaded_planes(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor);
/// Compares colours of rgba8 and rgba16 frames, in codes, where both sides have the same winner. Tolerance: `codes`,
/// plus the whole codes within the bound of compare_shaded_planes() (slivers). Background: 0, or 1 where the clear
/// colour lies half way between two codes.
Measurement compare_codes(const Scene& scene, const Capture& candidate, const Capture& reference, double codes,
                          double factor);

/// Frames with blending, colour masks or logic ops, against a reference with arithmetic of its own (llvmpipe: 8 bits).
/// Tolerance for n fragments drawn at a pixel: n `codes`, or (2^n - 1) `codes` where any blend factor reads the frame,
/// plus the sum of the fragments' colour bounds (FragmentBounds by `factor`), multiplied as blending may multiply
/// errors. rgba32f: that sum, plus the roundings of blending [u]. Where it is open which fragments made the colour, any
/// finite number is legal. Codes that a logic op makes must be equal where the codes of all fragments, and of the clear
/// colour if the logic op reads that, are certain and nothing is blended; else any code is legal, because operands one
/// code apart may differ in every bit.
Measurement compare_blended(const Scene& scene, const Capture& candidate, const Capture& reference, const Legal& legal,
                            double codes, double factor);

/// Compares the candidate's colour and depth with those that exact makes of the candidate's fragments: codes within
/// `factor` half codes of the unrounded colour; rgba32f and depth equal. `bounds`: interval of each pixel's unrounded
/// colour (Legal::color_lo, color_hi); empty: exact's colour alone. `conventions`: the candidate's rounding to codes,
/// and encoding. Without a depth plane, colours alone are compared. `roundings`: tolerance of each pixel of rgba32f
/// [u]; empty: 0.
Measurement compare_merge(const Scene& scene, const Planes& candidate, const Planes& exact, double factor,
                          const Legal& bounds = {}, const Conventions& conventions = {},
                          const Plane<double>& roundings = {});

/// Declared properties of a candidate's depths in a depth format that has codes.
struct DeclaredCodes {
  bool has_codes = false;                                        ///< each depth must be a code of the format
  std::optional<Conventions::Rounding> rounding = std::nullopt;  ///< of depths; none: one step either way is legal
  double product_error = 0;                                      ///< of a depth times the largest code, in float [step]
};

/// Comparators against legal answers. A pixel with several answers counts as ambiguous; in merge, where colours are
/// intervals (Legal::color_lo), only a pixel whose interval is infinite. The answer with the candidate's winner bounds
/// depth (by `factor` steps of the format) and colour (by `factor` times the answer's bound). Where no answer has that
/// winner, visibility reports the pixel, and depth and colour need only be finite. Where the candidate shows no
/// winners, the nearest answer counts (for colour: the nearest of those that have the pixel's depth), and visibility
/// compares the stencil values alone. Where only the cleared frame is legal, merge compares the depth if there is a
/// colour plane. Shaded colours may be clamped to [0, 1] where the frame holds codes.
Measurement compare_legal_count(const Planes& candidate, const Legal& legal);
Measurement compare_legal_winner(const Planes& candidate, const Legal& legal);
Measurement compare_legal_depth(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                const DeclaredCodes& declared = {});
Measurement compare_legal_shaded(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                 const Conventions& conventions = {});
Measurement compare_legal_merge(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                const Conventions& conventions = {});

}  // namespace plumbline::check

// Comparators of planes, stages 5 to 11: against another renderer's planes, and against an oracle's legal answers.
#pragma once

#include <optional>

#include "capture/capture.h"
#include "capture/conventions.h"
#include "check/verdict/measure.h"
#include "scene/scene.h"

namespace plumbline::check {

/// Overdraw count and sum of weights, both with tolerance zero. A pixel is open where `legal` (empty: nowhere) allows
/// several counts, the candidate's among them. If a pixel that is not open differs, differences at open pixels are
/// ambiguous; if open pixels alone differ, they count as different.
Measurement compare_coverage(const Planes& candidate, const Planes& reference, const Legal& legal = {});

/// Winners and their stencil values. Where they differ: ambiguous if both sides' are among the legal answers, disputed
/// if the candidate's alone are, else different. `legal` empty: different.
Measurement compare_winners(const Planes& candidate, const Planes& reference, const Legal& legal);

/// Depth and colour at the pixels where both sides have the same winner; compare_winners judges the other pixels.
/// Tolerance: `factor` u of the magnitude of a plane that is evaluated in float from the window's origin (bounds.h),
/// and one step of the format for depth, FragmentBound::apart (fragment_bounds.h) for colour; 0 where nothing is drawn.
/// Along a line the reference may interpolate by the major axis (bounds.h): the nearer of the two values counts.
Measurement compare_depth_planes(const Scene& scene, const Capture& candidate, const Capture& reference, double factor);
Measurement compare_shaded_planes(const Scene& scene, const Capture& candidate, const Capture& reference,
                                  double factor);
/// rgba8 and rgba16, in codes: at most `codes` where the winners are the same, and the whole codes that the bound of
/// compare_shaded_planes comes to (slivers).
Measurement compare_codes(const Scene& scene, const Capture& candidate, const Capture& reference, double codes,
                          double factor);

/// Frames with blending, colour masks or logic ops, against a reference with arithmetic of its own (llvmpipe: 8 bits).
/// Tolerance for n fragments drawn at a pixel: n `codes`, or (2^n - 1) `codes` where a blend factor reads the frame,
/// and what `factor` u of all their colours' bounds comes to; for rgba32f that and the blends' own roundings [u]. Where
/// it is open which fragments made the colour, any number is legal. Codes that a logic op makes must be equal where the
/// codes of all fragments, and of the clear colour if the logic op reads it, are certain and nothing is blended; else
/// any code is legal, because operands one code apart may differ in every bit.
Measurement compare_blended(const Scene& scene, const Capture& candidate, const Capture& reference, const Legal& legal,
                            double codes, double factor);

/// The candidate's planes against what exact makes of the candidate's fragments: codes within `factor` half codes of
/// the unrounded colour; rgba32f and depth equal. `bounds`: intervals of colours that roundings before merge may move,
/// or empty. `conventions`: the candidate's rounding to codes, and encoding. A candidate without a depth plane is
/// compared by colours alone. `roundings`: tolerance of each pixel of rgba32f [u]; empty: 0.
Measurement compare_merge(const Scene& scene, const Planes& candidate, const Planes& exact, double factor,
                          const Legal& bounds = {}, const Conventions& conventions = {},
                          const Plane<double>& roundings = {});

/// Codes that a candidate leaves in a format that has codes, as it declares them.
struct DeclaredCodes {
  bool has_codes = false;                                        ///< each depth must be a code of the format
  std::optional<Conventions::Rounding> rounding = std::nullopt;  ///< of depths; none: one step either way is legal
};

/// Against legal answers; a pixel with several answers counts as ambiguous. The answer that has the pixel's own winner
/// bounds depth (by `factor` steps of the format) and colour (by `factor` times its bound). Where no answer has that
/// winner, visibility reports the pixel, and depth and colour need only be finite. Where the candidate shows no
/// winners, the nearest answer counts, for colour of those that have the pixel's depth; visibility then judges the
/// stencil values alone. Where only the cleared frame is legal, merge judges the depth if a colour plane is there.
/// Shaded colours may be clamped to [0, 1] where the frame holds codes.
Measurement compare_legal_count(const Planes& candidate, const Legal& legal);
Measurement compare_legal_winner(const Planes& candidate, const Legal& legal);
Measurement compare_legal_depth(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                const DeclaredCodes& declared = {});
Measurement compare_legal_shaded(const Scene& scene, const Planes& candidate, const Legal& legal, double factor);
Measurement compare_legal_merge(const Scene& scene, const Planes& candidate, const Legal& legal, double factor,
                                const Conventions& conventions = {});

}  // namespace plumbline::check

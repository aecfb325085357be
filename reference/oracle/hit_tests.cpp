// Possible outcomes of a hit's alpha test, and its stencil state.
#include <cmath>
#include <cstdint>

#include "capture/fragment_outcomes.h"
#include "reference/oracle/pixel_hit.h"

namespace plumbline::math {

namespace {

Outcomes alpha_test(const AlphaTest& test, ColorFormat format, Conventions::AlphaTest numbers, double lo, double hi) {
  const Outcomes in_codes = alpha_outcomes(test, format, lo, hi),
                 in_float = alpha_outcomes(test, ColorFormat::rgba32f, lo, hi);
  switch (numbers) {
    case Conventions::AlphaTest::in_codes: return in_codes;
    case Conventions::AlphaTest::in_float: return in_float;
    case Conventions::AlphaTest::either: break;
  }
  return {in_codes.may_pass || in_float.may_pass, in_codes.may_fail || in_float.may_fail};
}

/// Largest number of a triangle's pieces that may cover the pixel of the hit. Possible hit of a cut triangle: two, as
/// snapping may turn over a sliver of the fan, which then covers the pixel together with its neighbour. Inclusive tie
/// rule: two on a diagonal of the fan; at the border seven, where all pieces of 9 corners may meet at one corner.
std::uint32_t most_pieces(const Triangle& t, const PixelHit& hit, Conventions::TieRule rule) {
  if (!t.cut) return 1;
  if (rule != Conventions::TieRule::inclusive) return hit.hit.certain ? 1 : 2;
  return !hit.hit.certain ? 7 : hit.at_diagonal ? 2 : 1;
}

}  // namespace

void set_tests(const Draw& draw, const Triangle& t, const FrameFormat& frame, const Conventions& conventions,
               PixelHit& out) {
  Hit& hit = out.hit;
  if (draw.alpha_test) {
    const bool bounded = std::isfinite(out.alpha_bound);
    const double lo = hit.color.a - out.alpha_bound, hi = hit.color.a + out.alpha_bound;
    const Outcomes alpha =
        bounded ? alpha_test(*draw.alpha_test, frame.color, conventions.alpha_test, lo, hi) : Outcomes{true, true};
    hit.alpha_passes = alpha.may_pass;
    hit.alpha_fails = alpha.may_fail;
  }
  hit.pieces = most_pieces(t, out, conventions.tie_rule);
  if (!draw.stencil) return;
  const bool front = t.sign > 0;
  hit.stencil = front ? &draw.stencil->front : &draw.stencil->back;
  // Snapping may reverse a sliver, or a piece at the border of a cut triangle: either face is legal.
  const bool either = t.flat || (!hit.certain && (t.thin || t.cut));
  if (either) hit.or_stencil = front ? &draw.stencil->back : &draw.stencil->front;
}

}  // namespace plumbline::math

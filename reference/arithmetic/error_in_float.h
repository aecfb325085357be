// Error of depths and attributes interpolated in float, by the declared arithmetic (capture/float_depth.h).
#pragma once

#include <glm/glm.hpp>

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

/// Least altitudes of a cut triangle's pieces [pixels]: cut at the frame's sides too, or guarded (Triangle).
struct PieceAltitudes {
  double framed, guarded;
};
/// Error of the depth of a triangle, and of its pieces if cut, at the ray d [window z]. 0 for a renderer in double;
/// infinite where a piece may have no area.
double error_in_float(const Projected& scene, const Triangle& triangle, glm::dvec3 d, const PieceAltitudes& altitudes);

/// Relative error at the ray d of an attribute's numerator or denominator: shares_error() of the whole triangle, unless
/// it reaches behind the eye; of a cut triangle also the error of a plane in its pieces, of values of at most 1 and
/// that `slope` [1 / pixel]. Pieces that may have no area are left out: their bound would allow any colour, and so hide
/// wrong cuts.
double shares_error_in_float(const Projected& scene, const Triangle& triangle, glm::dvec3 d,
                             const PieceAltitudes& altitudes, double slope);

}  // namespace plumbline::math

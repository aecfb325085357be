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

/// Relative error of an attribute's numerator or denominator at the ray d: shares_error() of the whole triangle, if it
/// is wholly before the eye; of a cut triangle, if larger, the error of a plane in a piece, of values of at most 1 and
/// of that `slope` [1 / pixel]. Leaves out pieces that may have no area: their bound would allow any colour, and so
/// hide wrong cuts.
double shares_error_in_float(const Projected& scene, const Triangle& triangle, glm::dvec3 d,
                             const PieceAltitudes& altitudes, double slope);

}  // namespace plumbline::math

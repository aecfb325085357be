// Error of what a renderer interpolates in float, by the arithmetic that it declares (capture/float_depth.h).
#pragma once

#include <glm/glm.hpp>

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

/// Least altitudes of a cut triangle's pieces [pixels]: cut at the frame's sides too, or guarded (Triangle).
struct PieceAltitudes {
  double framed, guarded;
};
/// Error of a triangle's depth at the ray d [window z]; if the triangle is cut, of its pieces' depths, too. 0 for a
/// renderer in double; infinite where a piece may have no area.
double error_in_float(const Projected& scene, const Triangle& triangle, glm::dvec3 d, const PieceAltitudes& altitudes);

/// shares_error() at the ray d, of the whole triangle. The pieces of a cut triangle are not bounded: their bound would
/// allow any colour, and so hide wrong cuts. 0 for a triangle that reaches behind the eye.
double shares_error_in_float(const Projected& scene, const Triangle& triangle, glm::dvec3 d);

}  // namespace plumbline::math

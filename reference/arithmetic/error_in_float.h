// Error of depths that a renderer interpolates in float, as it declares (capture/float_depth.h).
#pragma once

#include <glm/glm.hpp>

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

/// Of a triangle's depth at the ray d [window z]; of one that is cut, of its pieces as well, of at least `altitude`
/// [pixels]. 0 of a renderer in double; infinite where a piece may have no area.
double error_in_float(const Projected& scene, const Triangle& triangle, glm::dvec3 d, double altitude);

}  // namespace plumbline::math

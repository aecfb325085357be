// A triangle's polygon offset (OpenGL 2.1 spec 3.5.5), with a bound on its error in float arithmetic.
#pragma once

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

/// The offset of a triangle, all else of which project() has set up; `half` is infinite where the triangle has no
/// reliable plane. r of unorm formats is that of the conventions.
OffsetBounds polygon_offset(const Projected& scene, const Triangle& triangle, const PolygonOffset& offset);

}  // namespace plumbline::math

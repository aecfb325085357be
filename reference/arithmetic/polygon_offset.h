// A triangle's polygon offset (OpenGL 2.1 spec 3.5.5), with a bound on its error in float arithmetic.
#pragma once

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

/// r of OpenGL 4.5, section 14.6.5 [window z]. Float depths: distance from the last float at or below `largest_z` to
/// the next one, or the conventions' float_offset_unit. Codes (OpenGL leaves r open): offset_unit codes.
long double offset_unit(DepthFormat format, const Conventions& conventions, double largest_z);

/// Offset of a triangle whose other members project() has set. `half`: infinite where the triangle has no reliable
/// plane. r of every format: offset_unit().
OffsetBounds polygon_offset(const Projected& scene, const Triangle& triangle, const PolygonOffset& offset);

}  // namespace plumbline::math

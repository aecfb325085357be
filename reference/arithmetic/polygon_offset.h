// A triangle's polygon offset (OpenGL 2.1 spec 3.5.5), with a bound on its error in float arithmetic.
#pragma once

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

/// Interval middle +- half [window z]; half is infinite where the triangle has no reliable plane.
struct OffsetBounds {
  double middle = 0, half = 0;
};
/// The offset of a triangle that project() has set up. r of unorm formats is that of the conventions.
OffsetBounds polygon_offset(const Triangle& triangle, const PolygonOffset& offset, DepthFormat format,
                            const Conventions& conventions);

}  // namespace plumbline::math

// A triangle's polygon offset (OpenGL 2.1 spec 3.5.5), and what float arithmetic before it may make of it.
#pragma once

#include "reference/arithmetic/projected.h"

namespace plumbline::math {

/// middle +- half, in window z; half is infinite where the triangle has no plane to rely on.
struct OffsetBounds {
  double middle = 0, half = 0;
};
/// r of formats of codes is that of the conventions.
OffsetBounds polygon_offset(const Triangle& triangle, const PolygonOffset& offset, DepthFormat format,
                            const Conventions& conventions);

}  // namespace plumbline::math

// Barycentric weights of a point in a window triangle or along a line.
#pragma once

#include "capture/stages.h"

namespace plumbline::check {

/// Barycentric weights at a point, and their slopes [1/pixel]. Triangle: of the unsnapped corners (stages.h, 6); of the
/// snapped ones where the unsnapped area contradicts the facing. Line: by projection.
struct Barycentrics {
  Vec3<double> value, d_dx, d_dy;
};

/// Weights of the point (x, y) [pixel]; their sum is 1. Not finite where the snapped corners have no area either.
Barycentrics barycentrics(const WindowTriangle<double>& triangle, double x, double y);
/// Weights of the point's projection onto a line; value[1] is the share of the way to the line's second end.
Barycentrics along_line(const WindowTriangle<double>& line, double x, double y);

}  // namespace plumbline::check

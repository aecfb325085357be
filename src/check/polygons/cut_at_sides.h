// Clip polygons of renderers that leave the sides of the view volume to the raster.
#pragma once

#include "capture/capture.h"

namespace plumbline::check {

/// Records with their polygons cut at the sides of the view volume, in double. A polygon is cut at a side if one of its
/// vertices is beyond that side by more than rounding, 2^-16 of its largest coordinate: a renderer may cut at the side,
/// farther out (guard band), or not at all, since no pixel of the frame lies beyond. Polygons wholly beyond a side are
/// left out; lines and points stay unchanged. Varyings are not cut: their columns no longer fit the vertices.
Records<double> cut_at_sides(Records<double> records);

}  // namespace plumbline::check

// Clip polygons of renderers that leave the sides of the view volume to the raster.
#pragma once

#include "check/compare/compare_records.h"

namespace plumbline::check {

/// The records with their polygons cut at the sides of the view volume, in double. A polygon is cut at a side that one
/// of its vertices is beyond by more than rounding, 2^-16 of its largest coordinate: a renderer may cut there, farther
/// out (a guard band), or not at all, since no pixel of the frame lies there. Polygons beyond a side are left out;
/// lines and points stay as they are.
Records<double> cut_at_sides(Records<double> records);

}  // namespace plumbline::check

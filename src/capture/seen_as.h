// View of a varying as the colour: comparators of colours then serve varyings.
#pragma once

#include "capture/stages.h"

namespace plumbline {

/// The records with the varying as the colour of vertices, clipped polygons, window triangles and fragments; polygons
/// and triangles are left out where the varying's columns have another size, as are lights, depth, texels, shaded and
/// drawn.
Records<double> seen_as(const Records<double>& records, Varying varying);

}  // namespace plumbline

// View of a varying as the colour: comparators of colours then serve varyings.
#pragma once

#include "capture/stages.h"

namespace plumbline {

/// Records with the varying as the colour of vertices, clipped polygons, window triangles and fragments. Leaves out
/// polygons or triangles where the varying's columns have another size, and always lights, depth, texels, shaded and
/// drawn.
Records<double> seen_as(const Records<double>& records, Varying varying);

}  // namespace plumbline

// A varying in the colour's place, for whatever does with it what it does with the colour.
#pragma once

#include "capture/stages.h"

namespace plumbline {

/// The records with the varying as the colour of vertices, cut polygons, window triangles and fragments, as far as its
/// columns are there and fit. Depth, shaded and drawn are left out.
Records<double> seen_as(const Records<double>& records, Varying varying);

}  // namespace plumbline

// The lists of faults (faults.h), each in the file of its name.
#pragma once

#include <span>

#include "faults/fault.h"

namespace plumbline::faults {

std::span<const Fault> of_vertices();     ///< stages 0 and 1
std::span<const Fault> of_light();        ///< the light equation, at the vertices (stage 2) and per fragment (stage 9)
std::span<const Fault> of_light_terms();  ///< terms of the light equation, in stages 2 and 9
std::span<const Fault> of_polygons();     ///< stages 3 and 4
std::span<const Fault> of_raster();       ///< stages 5 to 7
std::span<const Fault> of_scanline();     ///< stages 5 to 7, of scanline rasterizers
std::span<const Fault> of_textures();     ///< stages 8 and 9
std::span<const Fault> of_fog();          ///< stage 9
std::span<const Fault> of_merge();        ///< stages 10 to 12
std::span<const Fault> of_corner_values();  ///< stage 4: corners' values in another order

}  // namespace plumbline::faults

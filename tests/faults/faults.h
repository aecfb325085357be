// All faults (fault.h).
#pragma once

#include <span>
#include <vector>

#include "faults/fault.h"

namespace plumbline::faults {

/// By stage.
std::span<const Fault> of_stages();
/// Those, and the notes' (notes.h).
std::vector<Fault> all();
/// No fault: polygons are cut at eight times the view volume's width and height, and the frame's sides are left to the
/// raster.
void use_guard_band(pipeline::Stages& stages);

}  // namespace plumbline::faults

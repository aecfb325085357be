// All faults (fault.h).
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "faults/fault.h"

namespace plumbline::faults {

/// The faults of all stages, list after list as in lists.h.
std::span<const Fault> of_stages();
/// of_stages(), then of_notes() (notes.h).
std::vector<Fault> all();
/// The fault of all() that has the name. Throws std::out_of_range, with the name, where none has.
Fault named(std::string_view name);
/// No fault, but a legal guard band: polygons are cut at the near and far planes and at eight times the view volume's
/// width and height; coverage ends at the frame.
void use_guard_band(pipeline::Stages& stages);

}  // namespace plumbline::faults

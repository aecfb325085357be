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

}  // namespace plumbline::faults

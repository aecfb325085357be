// Bugs of textures, for faults.h's list.
#pragma once

#include <span>

#include "faults/faults.h"

namespace plumbline::faults {

std::span<const Fault> of_textures();

}  // namespace plumbline::faults

// Bugs in the light equation (stage 2).
#pragma once

#include <span>

#include "faults/faults.h"

namespace plumbline::faults {

std::span<const Fault> of_light();

}  // namespace plumbline::faults

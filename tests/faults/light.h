// Bugs in the light equation, at the vertices (stage 2) and per fragment (stage 9).
#pragma once

#include <span>

#include "faults/faults.h"

namespace plumbline::faults {

std::span<const Fault> of_light();

}  // namespace plumbline::faults

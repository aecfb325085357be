// Functions that end the process, or never end: for tests of what becomes of the other rows. None is a bug that is
// listed.
#pragma once

#include <span>

#include "faults/fault.h"

namespace plumbline::faults {

std::span<const Fault> endings();

}  // namespace plumbline::faults

// How much of a long campaign a run takes.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace plumbline {

/// With PLUMBLINE_ALL in the environment (the tests of label "slow": scripts/test all) each case, else one of `every`.
inline std::size_t one_of(std::size_t every) { return std::getenv("PLUMBLINE_ALL") != nullptr ? 1 : every; }

}  // namespace plumbline

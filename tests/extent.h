// The part of a campaign that a run takes.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace plumbline {

/// Stride over cases: 1 with PLUMBLINE_ALL in the environment (label "slow": scripts/test all), else `every`.
inline std::size_t one_of(std::size_t every) { return std::getenv("PLUMBLINE_ALL") != nullptr ? 1 : every; }

}  // namespace plumbline

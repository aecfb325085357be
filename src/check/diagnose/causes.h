// Likely causes of a wrong stage, in words: exact comes to the candidate's records with the cause in its input or
// output, or the differences of all records show the cause's pattern.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/diagnose/evidence.h"

namespace plumbline::check {

struct Cause {
  std::string_view name;  ///< such as "window.y_flipped"
  std::string words;      ///< the cause, and what shows it
};

/// Causes that explain at least 49 in 50 of the records that differ (the rest: ties, and what rounding decides), those
/// first that leave fewest; of as many, and where the pattern of the differences shows them, in the order of
/// known_causes.h. One that leaves records which another explains is none.
std::vector<Cause> likely_causes(const Evidence& evidence);

}  // namespace plumbline::check

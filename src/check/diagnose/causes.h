// Likely causes of a wrong stage, in words. A cause is likely if exact, with the cause put into its input or output,
// makes the candidate's records, or if the differences of all records show the cause's pattern.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "check/diagnose/evidence.h"

namespace plumbline::check {

struct Cause {
  std::string_view name;  ///< such as "window.y_flipped"
  std::string words;      ///< the cause
  std::string shown{};    ///< what shows it, after a space; or empty
};

/// Likely causes. First: causes whose pattern the differences show. Then: of the causes that the referee tries, those
/// that leave the fewest records unexplained, at most 1 in 50 of the differing records (ties, and what rounding
/// decides). Both parts are in the order of known_causes.h. Several causes that leave no record at all are not
/// named: the one cause "nothing_left" stands for all of them. Empty without a referee.
std::vector<Cause> likely_causes(const Evidence& evidence);

}  // namespace plumbline::check

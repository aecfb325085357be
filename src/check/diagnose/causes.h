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

/// Likely causes: first those whose pattern the differences show, then, of those that the referee tries, the ones that
/// leave the fewest differing records, if at most 1 in 50 of them (ties, and what rounding decides). Both parts are in
/// the order of known_causes.h. Empty without a referee.
std::vector<Cause> likely_causes(const Evidence& evidence);

}  // namespace plumbline::check

// A hint for a misspelt name.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace plumbline {

/// The name that was probably meant by `word`, as a question: ` (did you mean "camera"?)`. The one name that begins
/// with `word` (of 4 letters or more); else the name nearest in Levenshtein's distance, if that is at most 3 and at
/// most half of the name's letters; else, and for a word of more than 40 letters, empty.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> names);

}  // namespace plumbline

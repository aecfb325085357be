// A hint for a misspelt name.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace plumbline {

/// The name nearest to a misspelt one, as a question: ` (did you mean "camera"?)`. Empty where none is near: at most 3
/// letters put in, left out or replaced, and at most half of them.
std::string did_you_mean(std::string_view word, std::span<const std::string_view> names);

}  // namespace plumbline

// Text of unknown bytes as UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace plumbline {

/// The text with U+FFFD for each byte that is no UTF-8.
std::string as_utf8(std::string_view text);

}  // namespace plumbline

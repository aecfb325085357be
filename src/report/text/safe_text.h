// Text made safe for UTF-8, HTML and links.
#pragma once

#include <string>
#include <string_view>

namespace plumbline::report {

/// The text with U+FFFD for each byte that is no UTF-8.
std::string as_utf8(std::string_view text);
/// as_utf8(text) with HTML's own characters written as entities.
std::string escaped(std::string_view text);
/// A relative path for `text`, safe in file systems and links, different for different texts: each byte other than
/// ASCII letters and digits, "-", "_", "." and "/", and each "." that begins a name, becomes its number, "~20".
std::string file_name(std::string_view text);

}  // namespace plumbline::report

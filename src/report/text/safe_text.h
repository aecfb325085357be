// Text made safe for UTF-8, HTML and links.
#pragma once

#include <string>
#include <string_view>

namespace plumbline::report {

/// The text with U+FFFD for each byte that is no UTF-8.
std::string as_utf8(std::string_view text);
/// The same with HTML's own characters written as entities.
std::string escaped(std::string_view text);
/// A relative path that any file system takes and a link may hold as it is, another for each text: what is none of
/// ASCII's letters and digits, "-", "_", "." and "/" becomes its bytes' numbers, "~20".
std::string file_name(std::string_view text);

}  // namespace plumbline::report

// Text made safe for HTML and links.
#pragma once

#include <string>
#include <string_view>

namespace plumbline::report {

/// as_utf8(text) with HTML's own characters written as entities.
std::string escaped(std::string_view text);
/// A relative path for `text`, safe in file systems and links, different for different texts: each byte other than
/// ASCII letters and digits, "-", "_", "." and "/", each "." that begins a name, and each "/" that does not lie between
/// two names, becomes its number, "~20".
std::string file_name(std::string_view text);

}  // namespace plumbline::report

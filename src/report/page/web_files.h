// The pages' style and script, files of web/, as text.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace plumbline::report {

/// One of web/'s files. Throws std::logic_error if there is none of that name.
std::string_view web_file(std::string_view name);
/// Files of web/ in the order of `names`, each ended by a new line.
std::string web_files(std::initializer_list<std::string_view> names);

}  // namespace plumbline::report

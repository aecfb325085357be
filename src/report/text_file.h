#pragma once

#include <filesystem>
#include <string>

namespace plumbline::report {

/// Writes the whole file or, on failure, none of it. Throws std::runtime_error naming the file and the reason.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace plumbline::report

// Programs that may crash or never end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::mutation {

/// How a program ended.
struct Ended {
  int code = 0;     ///< its exit code, where it ended of its own
  std::string how;  ///< "", "SIGSEGV ..." or "no end within 60 s"
  bool ok() const { return how.empty() && code == 0; }
};

/// Runs a program with at most 8 GiB for each process; what it prints goes into the file `output` (errors too). After
/// `seconds` it and all that it started are killed. Throws std::runtime_error where it cannot be started.
Ended run(const std::vector<std::string>& argv, const std::filesystem::path& output, unsigned seconds);

/// The bytes of a file; none where it cannot be read.
std::string text_of(const std::filesystem::path& file);

}  // namespace plumbline::mutation

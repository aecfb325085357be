// Programs that may crash or never end.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace plumbline::mutation {

/// How a program ended.
struct Ended {
  int code = 0;     ///< its exit code, where it ended of its own
  std::string how;  ///< "", the signal as strsignal() has it, or "no end within 60 s"
  bool ok() const { return how.empty() && code == 0; }
};

/// Runs a program with at most 8 GiB of address space for each process; stdout and stderr go into the file `output`. At
/// its end, or after `seconds`, all that is left of its process group is killed. Throws std::runtime_error where it
/// cannot be started, which its exit code 127 counts as.
Ended run(const std::vector<std::string>& argv, const std::filesystem::path& output, unsigned seconds);

/// The bytes of a file; none where it cannot be read.
std::string text_of(const std::filesystem::path& file);

}  // namespace plumbline::mutation

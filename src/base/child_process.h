// Programs of plumbline's own, for work that may crash or never end.
//
// Not a copy of this process (fork): it may have threads, and what they hold at that moment, a lock of the memory
// allocator say, is held in the copy for ever (POSIX, fork()).
#pragma once

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace plumbline {

/// The program gave no answer. The message says why, as words that follow its name: "crashes (Killed)".
struct ChildFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs a program whose main() calls answer_parent(), and returns the answer; kills the program after `seconds`.
/// `program` is a name in the folders where this program's libraries are looked for (DT_RPATH). The program's stderr is
/// lost. Throws ChildFailed; std::runtime_error where there is no such program or no process, and with the exception's
/// words where the program's work throws.
std::string answer_of_child(const std::string& program, const std::vector<std::string>& arguments, unsigned seconds);

/// Does the work, limited to 4 GiB of address space beyond the program's own, writes the result to stdout for
/// answer_of_child(), and ends the program.
[[noreturn]] void answer_parent(const std::function<std::string()>& work);

}  // namespace plumbline

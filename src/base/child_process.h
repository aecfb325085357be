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

/// Answer of the program, which may take `seconds`. It is looked for where the libraries of this one are (DT_RPATH),
/// and its main() is answer_parent(). What it writes to stderr is lost. Throws ChildFailed; std::runtime_error where
/// there is no such program or no process for it, and where its work throws an exception, with the exception's words.
std::string answer_of_child(const std::string& program, const std::vector<std::string>& arguments, unsigned seconds);

/// Does the work, which may take 4 GiB of memory beyond what the program has, and writes its result to stdout, for
/// answer_of_child(). Ends the program.
[[noreturn]] void answer_parent(const std::function<std::string()>& work);

}  // namespace plumbline

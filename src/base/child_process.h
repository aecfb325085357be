// Work that may crash or never end.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace plumbline {

/// The work did not come to an end of its own: the message says how it ended, as words that follow "found".
struct ChildFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Does the work in a copy of this process and hands back its result, so that libraries which crash, hang or take all
/// memory on bad input take nothing else with them. The work may take `seconds`, and 4 GiB beyond what this process
/// has; what it prints is lost. Throws ChildFailed, or a std::runtime_error that says what an exception of the work
/// said.
std::string in_child_process(const std::function<std::string()>& work, unsigned seconds);

}  // namespace plumbline

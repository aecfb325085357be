// Messages to the person at the terminal.
#pragma once

#include <string>

namespace plumbline::cli {

/// Prints "plumb: message" on stderr. A closed stderr loses it, and is no error.
void say(const std::string& message);

}  // namespace plumbline::cli

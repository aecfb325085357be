#include "cli/options/say.h"

#include <cstdio>

namespace plumbline::cli {

void say(const std::string& message) { std::fputs(("plumb: " + message + "\n").c_str(), stderr); }

}  // namespace plumbline::cli

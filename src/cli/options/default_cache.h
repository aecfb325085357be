// The folder of --cache.
#pragma once

#include <string>

namespace plumbline::cli {

/// $XDG_CACHE_HOME/plumbline, or ~/.cache/plumbline; empty where neither variable is an absolute path.
std::string default_cache();
/// Makes the folder. Where it cannot be made: throws std::invalid_argument, unless it is the default one: then empty.
std::string made_cache(const std::string& folder);

}  // namespace plumbline::cli

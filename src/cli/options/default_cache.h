// The folder of --cache.
#pragma once

#include <string>

namespace plumbline::cli {

/// $XDG_CACHE_HOME/plumbline, or ~/.cache/plumbline; empty where neither variable is an absolute path.
std::string default_cache();
/// Creates the folder and returns it. On failure: empty for default_cache(), else throws std::invalid_argument.
std::string made_cache(const std::string& folder);

}  // namespace plumbline::cli

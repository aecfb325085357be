// plumb's subcommands: each adds itself to the program's arguments, and runs if it was named.
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace plumbline::cli {

/// Exit codes of every subcommand; bad input and bad usage throw, which main() turns into 2.
enum Exit { kHolds = 0, kDiffers = 1, kBadInput = 2 };

/// To be run after parsing: the exit code, or -1 where another subcommand was chosen.
using Command = std::function<int()>;
Command add_render(CLI::App& app);
Command add_check(CLI::App& app);
Command add_capture(CLI::App& app);
Command add_list(CLI::App& app);

}  // namespace plumbline::cli

// plumb, the command line of plumbline, as a function.
#pragma once

namespace plumbline::cli {

/// What main() is handed; returns the exit code (commands.h). All that goes wrong is told on stderr.
int plumb_main(int argc, char** argv);

}  // namespace plumbline::cli

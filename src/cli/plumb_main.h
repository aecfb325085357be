// plumb, the command line of plumbline, as a function.
#pragma once

namespace plumbline::cli {

/// What main() is handed; returns the exit code (commands.h). Errors are written to stderr.
int plumb_main(int argc, char** argv);

}  // namespace plumbline::cli

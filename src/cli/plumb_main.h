// plumb, the command line of plumbline, as a function.
#pragma once

namespace plumbline::cli {

/// Runs plumb with main()'s arguments; returns the exit code (commands.h). Errors are written to stderr.
int plumb_main(int argc, char** argv);

}  // namespace plumbline::cli

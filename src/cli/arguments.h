// Parser of the command line. CLI11, which takes long to compile, is used in arguments.cpp and options/argument_kinds
// alone.
#pragma once

#include <functional>

namespace plumbline::cli {

/// The command that the arguments name, ready to run. Empty after --help or a usage error, which parse() has printed:
/// the program ends with `exit`.
struct Parsed {
  std::function<int()> command;
  int exit = 0;
};
Parsed parse(int argc, char** argv);

}  // namespace plumbline::cli

// Programs of other people, run and ended.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace plumbline {

/// How a program ended.
struct ProgramEnd {
  int start_error = 0;  ///< errno, where it could not be started
  bool hung = false;    ///< it took longer than the time limit and was killed
  int status = 0;       ///< else its wait status, for WIFEXITED() and its like
};

struct ProgramCall {
  std::vector<std::string> argv;         ///< argv[0] is looked for in PATH
  std::vector<std::string> environment;  ///< NAME=value, all of it
  std::filesystem::path error_log;       ///< stderr is appended to it; stdout is thrown away, stdin is empty
  std::chrono::milliseconds time_limit{60'000};
};

/// Runs a program until it ends or its time is over. Its descendants are killed then, those in sessions of their own
/// too; also where this process is killed meanwhile. Throws std::system_error where the system has no process or pipe.
ProgramEnd run_program(ProgramCall call);

}  // namespace plumbline

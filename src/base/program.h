// Programs of other people, run and ended.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumbline {

/// The longest line [bytes] that a server may answer.
inline constexpr std::size_t kLongestAnswer = 1 << 16;

/// How a program ended.
struct ProgramEnd {
  int start_error = 0;   ///< errno, where it could not be started
  bool hung = false;     ///< it took longer than the time limit and was killed
  bool spoke = false;    ///< a server answered before it was asked, and was killed
  bool rambled = false;  ///< a server's answer was longer than kLongestAnswer, and it was killed
  int status = 0;        ///< else its wait status, for WIFEXITED() and its like
};

struct ProgramCall {
  std::vector<std::string> argv;         ///< argv[0] is looked for in PATH
  std::vector<std::string> environment;  ///< NAME=value, all of it
  std::filesystem::path error_log;       ///< stderr is appended to it
  std::chrono::milliseconds time_limit{60'000};
  /// Folders in which alone it may write, no file beyond `most_bytes` (confine.h); empty: it may write everywhere.
  std::vector<std::string> writable = {};
  unsigned long most_bytes = 0;
  int conversation = -1;  ///< descriptor that is its stdin and stdout; -1: stdin is empty, stdout is thrown away
};

/// Runs a program until it ends or its time is over. Its descendants are killed then, those in sessions of their own
/// too; also where this process is killed meanwhile. Throws std::system_error where the system has no process or pipe.
ProgramEnd run_program(ProgramCall call);

/// A program that answers lines. It is ended, with its descendants, by the destructor, and where this process ends.
class ServerProgram {
 public:
  /// Starts it; the call's time limit is that of one answer. Throws std::system_error where the system has no process,
  /// pipe or socket.
  explicit ServerProgram(ProgramCall call);
  ~ServerProgram();
  ServerProgram(const ServerProgram&) = delete;
  ServerProgram& operator=(const ServerProgram&) = delete;

  /// Sends a line and returns the program's answer, a line without its end. None where the program ended, took longer
  /// than the time limit, answered beyond kLongestAnswer, or wrote before it was asked: it is killed then, and end()
  /// says why.
  std::optional<std::string> ask(const std::string& line);
  /// After an ask() without an answer.
  const ProgramEnd& end() const { return end_; }

 private:
  std::optional<std::string> answer();
  void stop();

  std::chrono::milliseconds time_limit_;
  int conversation_ = -1, ending_ = -1, guardian_ = -1;
  std::string heard_;  ///< bytes of the next answer, received so far
  ProgramEnd end_;
};

}  // namespace plumbline

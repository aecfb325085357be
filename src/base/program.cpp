#include "base/program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <system_error>
#include <utility>

#include "base/confine.h"
#include "base/supervise.h"

namespace plumbline {

namespace {

using Clock = std::chrono::steady_clock;

/// The strings as execve wants them.
std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> out;
  for (std::string& s : strings) out.push_back(s.data());
  out.push_back(nullptr);
  return out;
}

void open_as(int descriptor, const char* path, int flags) {
  const int file = ::open(path, flags, 0600);
  if (file < 0) return;
  ::dup2(file, descriptor);
  if (file != descriptor) ::close(file);
}

// Turns this process' limit of address space (RLIMIT_AS) into one of data (RLIMIT_DATA). A program may reserve more
// addresses than it uses, as browsers and virtual machines do.
void limit_data() {
  rlimit memory{};
  if (::getrlimit(RLIMIT_AS, &memory) != 0 || memory.rlim_cur == RLIM_INFINITY) return;
  rlimit data{};
  ::getrlimit(RLIMIT_DATA, &data);
  data.rlim_cur = data.rlim_max = std::min(memory.rlim_cur, data.rlim_max);  // the program cannot raise it
  ::setrlimit(RLIMIT_DATA, &data);
  memory.rlim_cur = memory.rlim_max;
  ::setrlimit(RLIMIT_AS, &memory);
}

/// Becomes the program (exec). Returns errno where that fails.
int become(const ProgramCall& call, char** argv, char** environment, char** writable, pid_t guardian) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != guardian) ::_exit(1);
  for (int signal = 1; signal < NSIG; ++signal) ::signal(signal, SIG_DFL);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  if (call.conversation >= 0) {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO}) ::dup2(call.conversation, descriptor);
  } else {
    open_as(STDIN_FILENO, "/dev/null", O_RDONLY);
    open_as(STDOUT_FILENO, "/dev/null", O_WRONLY);
  }
  open_as(STDERR_FILENO, call.error_log.c_str(), O_WRONLY | O_CREAT | O_APPEND);
  limit_data();
  if (*writable != nullptr) confine(writable, call.most_bytes);
  ::execvpe(argv[0], argv, environment);
  return errno;
}

timespec until(Clock::time_point deadline) {
  const auto left = std::max(Clock::duration::zero(), deadline - Clock::now());
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {static_cast<time_t>(seconds.count()), static_cast<long>(std::chrono::nanoseconds(left - seconds).count())};
}

/// Waits for the program's end, the deadline, or a signal (SIGTERM: the parent has ended). `hung` after the last two.
ProgramEnd wait_for(pid_t program, Clock::time_point deadline, const sigset_t& waited) {
  ProgramEnd end;
  while (true) {
    pid_t ended;
    int status = 0;
    while ((ended = ::waitpid(-1, &status, WNOHANG)) > 0) {
      if (ended != program) continue;
      end.status = status;
      return end;
    }
    const timespec left = until(deadline);
    const int signal = ::sigtimedwait(&waited, nullptr, &left);
    if (signal == SIGCHLD || (signal < 0 && errno == EINTR)) continue;
    end.hung = true;
    return end;
  }
}

/// The guardian: a process between plumb and the program. It is the program's child subreaper, so that orphans become
/// its children; it kills all of them at the end.
[[noreturn]] void guard(const ProgramCall& call, char** argv, char** environment, char** writable, pid_t parent,
                        int answer) {
  const Clock::time_point deadline = Clock::now() + call.time_limit;
  sigset_t waited;
  ::sigemptyset(&waited);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGCHLD}) ::sigaddset(&waited, signal);
  ::sigprocmask(SIG_BLOCK, &waited, nullptr);
  ::signal(SIGCHLD, SIG_DFL);
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(1);
  ProgramEnd end;
  int failure[2];
  if (::pipe2(failure, O_CLOEXEC) != 0) {
    end.start_error = errno;
  } else {
    const pid_t self = ::getpid(), program = ::fork();
    if (program == 0) {
      const int error = become(call, argv, environment, writable, self);
      [[maybe_unused]] const ssize_t written = ::write(failure[1], &error, sizeof error);
      ::_exit(127);
    }
    if (program < 0) end.start_error = errno;
    ::close(failure[1]);
    int error = 0;
    if (program > 0 && ::read(failure[0], &error, sizeof error) == sizeof error) end.start_error = error;
    if (end.start_error == 0) end = wait_for(program, deadline, waited);
    kill_children();
  }
  [[maybe_unused]] const ssize_t written = ::write(answer, &end, sizeof end);
  ::_exit(0);
}

// The guardian of a program, and the pipe on which it tells the end.
struct Guarded {
  pid_t guardian;
  int ending;
};
Guarded start(ProgramCall& call) {
  std::vector<char*> argv = pointers(call.argv), environment = pointers(call.environment),
                     writable = pointers(call.writable);
  int answer[2];
  if (::pipe2(answer, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t parent = ::getpid(), guardian = ::fork();
  if (guardian == 0) guard(call, argv.data(), environment.data(), writable.data(), parent, answer[1]);
  const int fork_error = errno;
  ::close(answer[1]);
  if (guardian < 0) {
    ::close(answer[0]);
    throw std::system_error(fork_error, std::generic_category(), "fork");
  }
  return {guardian, answer[0]};
}

ProgramEnd end_of(const Guarded& program) {
  ProgramEnd end;
  ssize_t got = -1;
  while ((got = ::read(program.ending, &end, sizeof end)) < 0 && errno == EINTR) {
  }
  while (::waitpid(program.guardian, nullptr, 0) < 0 && errno == EINTR) {
  }
  ::close(program.ending);
  if (got != sizeof end) throw std::system_error(ECHILD, std::generic_category(), "a program's guardian");
  return end;
}

}  // namespace

ProgramEnd run_program(ProgramCall call) { return end_of(start(call)); }

ServerProgram::ServerProgram(ProgramCall call) : time_limit_(call.time_limit) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw std::system_error(errno, std::generic_category(), "socketpair");
  conversation_ = ends[0];
  call.conversation = ends[1];
  call.time_limit = std::chrono::hours(24 * 365);  // it waits for lines
  try {
    const Guarded program = start(call);
    guardian_ = program.guardian;
    ending_ = program.ending;
  } catch (const std::system_error&) {
    ::close(ends[0]);
    ::close(ends[1]);
    throw;
  }
  ::close(ends[1]);
}

ServerProgram::~ServerProgram() {
  try {
    stop();
  } catch (const std::system_error&) {  // the guardian was killed: the kernel has ended the program
  }
}

void ServerProgram::stop() {
  if (guardian_ < 0) return;
  ::close(conversation_);
  ::kill(guardian_, SIGTERM);
  const Guarded program{std::exchange(guardian_, -1), ending_};
  end_ = end_of(program);
}

std::optional<std::string> ServerProgram::answer() {
  const Clock::time_point deadline = Clock::now() + time_limit_;
  std::size_t end_of_line;
  while ((end_of_line = heard_.find('\n')) == std::string::npos) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd readable{conversation_, POLLIN, 0};
    const int ready = left > 0 ? ::poll(&readable, 1, static_cast<int>(std::min<long>(left, 1 << 30))) : 0;
    if (ready < 0 && errno == EINTR) continue;
    char bytes[4096];
    const ssize_t got = ready > 0 ? ::recv(conversation_, bytes, sizeof bytes, 0) : 0;
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0 || heard_.size() > kLongestAnswer) return std::nullopt;
    heard_.append(bytes, static_cast<std::size_t>(got));
  }
  std::string line = heard_.substr(0, end_of_line);
  heard_.erase(0, end_of_line + 1);
  return line;
}

std::optional<std::string> ServerProgram::ask(const std::string& line) {
  const Clock::time_point start = Clock::now();
  const std::string bytes = line + '\n';
  std::optional<std::string> out;
  pollfd unasked{conversation_, POLLIN, 0};
  char first;
  if (!heard_.empty() || (::poll(&unasked, 1, 0) > 0 && ::recv(conversation_, &first, 1, MSG_PEEK) > 0)) {
    stop();
    end_.spoke = true;
    return std::nullopt;
  }
  if (guardian_ >= 0 && ::send(conversation_, bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0) out = answer();
  if (out) return out;
  const bool rambled = heard_.size() > kLongestAnswer, late = !rambled && Clock::now() - start >= time_limit_;
  // Where the program has ended by itself, its guardian has said so, or is about to.
  pollfd told{ending_, POLLIN, 0};
  if (!late && !rambled) ::poll(&told, 1, 1000);
  stop();
  end_.hung = late;
  end_.rambled = rambled;
  return std::nullopt;
}

}  // namespace plumbline

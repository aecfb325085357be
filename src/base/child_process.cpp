#include "base/child_process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <vector>

#include <fmt/format.h>

namespace plumbline {
namespace {

void write_all(int to, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(to, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
}

void set_limits(unsigned seconds) {
  signal(SIGALRM, SIG_DFL);
  alarm(seconds);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const rlim_t bytes = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + (rlim_t{4} << 30);
  const rlimit memory{bytes, bytes};
  if (pages > 0) setrlimit(RLIMIT_AS, &memory);
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) {
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
  }
}

[[noreturn]] void be_child(const std::function<std::string()>& work, unsigned seconds, int to) {
  char outcome = '+';
  std::string result;
  try {
    set_limits(seconds);
    result = work();
  } catch (const std::bad_alloc&) {
    outcome = '!';
    result = "one that takes more than 4 GiB of memory to read";
  } catch (const std::exception& error) {
    outcome = '-';
    result = error.what();
  } catch (...) {
    _exit(1);
  }
  write_all(to, &outcome, 1);
  write_all(to, result.data(), result.size());
  _exit(0);  // nothing that the parent will do at its own end
}

std::string read_all(int from) {
  std::string bytes;
  std::vector<char> buffer(1 << 20);
  while (true) {
    const ssize_t got = read(from, buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return bytes;
    bytes.append(buffer.data(), static_cast<std::size_t>(got));
  }
}

}  // namespace

std::string in_child_process(const std::function<std::string()>& work, unsigned seconds) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw ChildFailed(fmt::format("no pipe: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child < 0) {
    close(ends[0]);
    close(ends[1]);
    throw ChildFailed(fmt::format("no new process: {}", std::strerror(errno)));
  }
  if (child == 0) {
    close(ends[0]);
    be_child(work, seconds, ends[1]);
  }
  close(ends[1]);
  std::string bytes = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    throw ChildFailed(fmt::format("one that takes more than {} seconds to read", seconds));
  }
  if (WIFSIGNALED(status)) {
    throw ChildFailed(fmt::format("one on which its reader crashes ({})", strsignal(WTERMSIG(status))));
  }
  if (WEXITSTATUS(status) != 0 || bytes.empty()) throw ChildFailed("one on which its reader gives up");
  const char outcome = bytes.front();
  bytes.erase(0, 1);
  if (outcome == '!') throw ChildFailed(bytes);
  if (outcome == '-') throw std::runtime_error(bytes);
  return bytes;
}

}  // namespace plumbline

#include "base/child_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "base/process_limits.h"

namespace plumbline {
namespace {

// The first byte of an answer: what follows is the work's result, an exception's words, or how the work failed.
constexpr char kResult = '+', kThrown = '-', kFailed = '!';

std::optional<std::string> beside_libraries(const std::string& program) {
  Dl_serinfo size{};
  void* const self = dlopen(nullptr, RTLD_LAZY);
  if (self == nullptr || dlinfo(self, RTLD_DI_SERINFOSIZE, &size) != 0) return std::nullopt;
  const std::unique_ptr<char[]> memory(new char[size.dls_size]);
  auto* const folders = reinterpret_cast<Dl_serinfo*>(memory.get());
  folders->dls_size = size.dls_size, folders->dls_cnt = size.dls_cnt;
  if (dlinfo(self, RTLD_DI_SERINFO, folders) != 0) return std::nullopt;
  const Dl_serpath* const first = folders->dls_serpath;
  for (unsigned i = 0; i < folders->dls_cnt; ++i) {
    const std::string path = fmt::format("{}/{}", first[i].dls_name, program);
    if (access(path.c_str(), X_OK) == 0) return path;
  }
  return std::nullopt;
}

// Between fork() and execv(), where functions safe for signal handlers are allowed alone.
[[noreturn]] void become(char* const* argv, unsigned seconds, int to) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  signal(SIGALRM, SIG_DFL);
  alarm(seconds);
  leave_no_core();
  const int nowhere = open("/dev/null", O_RDWR), beyond_stderr = fcntl(to, F_DUPFD, STDERR_FILENO + 1);
  dup2(nowhere, STDIN_FILENO);
  dup2(beyond_stderr, STDOUT_FILENO);  // where the parent has closed its own, `to` may be that
  dup2(nowhere, STDERR_FILENO);
  close_range(STDERR_FILENO + 1, ~0u, CLOSE_RANGE_CLOEXEC);
  execv(argv[0], argv);
  _exit(1);
}

void write_all(int to, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(to, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);
    bytes += written;
    count -= static_cast<std::size_t>(written);
  }
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

std::string answer_of_child(const std::string& program, const std::vector<std::string>& arguments, unsigned seconds) {
  const std::optional<std::string> path = beside_libraries(program);
  if (!path) throw std::runtime_error(fmt::format("no program {} where plumbline's libraries are", program));
  std::vector<std::string> words = arguments;
  words.insert(words.begin(), *path);
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("no pipe: {}", std::strerror(errno)));
  const pid_t child = fork();
  if (child == 0) become(argv.data(), seconds, ends[1]);
  const int error = errno;
  close(ends[1]);
  std::string bytes = child < 0 ? "" : read_all(ends[0]);
  close(ends[0]);
  if (child < 0) throw std::runtime_error(fmt::format("no new process: {}", std::strerror(error)));
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    throw ChildFailed(fmt::format("takes more than {} seconds", seconds));
  }
  if (WIFSIGNALED(status)) throw ChildFailed(fmt::format("crashes ({})", strsignal(WTERMSIG(status))));
  if (WEXITSTATUS(status) != 0 || bytes.empty()) throw ChildFailed("ends without an answer");
  const char outcome = bytes.front();
  bytes.erase(0, 1);
  if (outcome == kFailed) throw ChildFailed(bytes);
  if (outcome == kThrown) throw std::runtime_error(bytes);
  return bytes;
}

void answer_parent(const std::function<std::string()>& work) {
  char outcome = kResult;
  std::string result;
  try {
    limit_memory(std::uint64_t{4} << 30);
    result = work();
  } catch (const std::bad_alloc&) {
    outcome = kFailed;
    result = "takes more than 4 GiB of memory";
  } catch (const std::exception& error) {
    outcome = kThrown;
    result = error.what();
  } catch (...) {
    _exit(1);
  }
  write_all(STDOUT_FILENO, &outcome, 1);
  write_all(STDOUT_FILENO, result.data(), result.size());
  _exit(0);  // no destructor of a library that has read bad input
}

}  // namespace plumbline

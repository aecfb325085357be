#include "mutation/run.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

namespace plumbline::mutation {

Ended run(const std::vector<std::string>& argv, const std::filesystem::path& output, unsigned seconds) {
  std::vector<char*> words;
  for (const std::string& word : argv) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  const int to = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (to < 0) throw std::runtime_error(fmt::format("{}: {}", output.string(), std::strerror(errno)));
  const pid_t child = fork();
  if (child == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing goes on when this program is ended
    const rlimit memory{rlim_t{8} << 30, rlim_t{8} << 30}, no_core{0, 0};
    setrlimit(RLIMIT_AS, &memory);
    setrlimit(RLIMIT_CORE, &no_core);
    dup2(to, STDOUT_FILENO);
    dup2(to, STDERR_FILENO);
    execvp(words[0], words.data());
    _exit(127);
  }
  close(to);
  if (child < 0) throw std::runtime_error(fmt::format("no new process: {}", std::strerror(errno)));
  setpgid(child, child);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  int status = 0;
  Ended out;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      continue;
    }
    kill(-child, SIGKILL);
    waitpid(child, &status, 0);
    out.how = fmt::format("no end within {} s", seconds);
    return out;
  }
  kill(-child, SIGKILL);  // whatever it left
  if (WIFSIGNALED(status)) out.how = strsignal(WTERMSIG(status));
  if (WIFEXITED(status)) out.code = WEXITSTATUS(status);
  if (out.code == 127) throw std::runtime_error(fmt::format("{}: cannot be run", argv[0]));
  return out;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace plumbline::mutation

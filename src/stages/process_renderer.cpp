#include "stages/process_renderer.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "stages/capture_folder.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// A fresh folder, removed in the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "plumbline-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw RendererFailed(fmt::format("{}: cannot be made: {}", name, std::strerror(errno)));
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// SIGINT, SIGTERM and SIGHUP wait until this thread has cleaned up: the process and its folder are gone before we are.
class HeldSignals {
 public:
  HeldSignals() {
    ::sigemptyset(&held_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaddset(&held_, signal);
    ::pthread_sigmask(SIG_BLOCK, &held_, &before_);
  }
  ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;
  const sigset_t& before() const { return before_; }
  bool any_came() const {
    sigset_t pending;
    if (::sigpending(&pending) != 0) return false;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      if (::sigismember(&pending, signal) == 1 && ::sigismember(&before_, signal) == 0) return true;
    }
    return false;
  }

 private:
  sigset_t held_{}, before_{};
};

std::string replaced(std::string text, std::string_view what, std::string_view by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += by.size()) text.replace(at, what.size(), by);
  return text;
}

/// The strings as execve wants them.
std::vector<char*> pointers(std::vector<std::string>& strings) {
  std::vector<char*> out;
  for (std::string& s : strings) out.push_back(s.data());
  out.push_back(nullptr);
  return out;
}

std::vector<std::string> merged_environment(const std::map<std::string, std::string>& extra) {
  std::vector<std::string> all;
  for (char** e = environ; *e != nullptr; ++e) {
    const std::string_view entry = *e;
    if (!extra.contains(std::string(entry.substr(0, entry.find('='))))) all.emplace_back(entry);
  }
  for (const auto& [name, value] : extra) all.push_back(fmt::format("{}={}", name, value));
  return all;
}

/// Starts a process as the head of a group of its own: nothing to read, stdout thrown away, stderr into `log`, signals
/// as they were before we held them. Returns 0 or an errno.
int spawn(std::vector<std::string> argv, std::vector<std::string> environment, const fs::path& log,
          const HeldSignals& signals, pid_t& pid) {
  posix_spawn_file_actions_t actions;
  posix_spawnattr_t attributes;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_init(&attributes);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
  posix_spawnattr_setsigmask(&attributes, &signals.before());
  posix_spawnattr_setpgroup(&attributes, 0);
  const int error =
      ::posix_spawnp(&pid, argv[0].c_str(), &actions, &attributes, pointers(argv).data(), pointers(environment).data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// How a process ended: its exit status, or in words what else came. Of another status than 0, in words as well.
struct Ending {
  std::string words;
  int status = 0;
};

/// Waits for a process' end. Its whole group is gone afterwards.
Ending wait_for(pid_t pid, std::chrono::milliseconds timeout, const HeldSignals& signals) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point deadline = Clock::now() + timeout;
  std::chrono::milliseconds pause{1};
  siginfo_t info{};
  // WNOWAIT: it stays a zombie, and its number its own, until its group is killed.
  while (::waitid(P_PID, static_cast<id_t>(pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno == EINTR) {
    if (info.si_pid != 0 || Clock::now() >= deadline || signals.any_came()) break;
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::milliseconds{20});
  }
  const bool hung = info.si_pid == 0;
  ::kill(-pid, SIGKILL);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0) {
    if (errno != EINTR) return {fmt::format("could not be waited for: {}", std::strerror(errno))};
  }
  if (hung && signals.any_came()) return {"was killed, for we were told to end"};
  if (hung) return {fmt::format("took longer than {} and was killed", timeout)};
  if (WIFSIGNALED(status)) {
    return {fmt::format("was killed by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))};
  }
  if (WEXITSTATUS(status) == 0) return {};
  return {fmt::format("exited with status {}", WEXITSTATUS(status)), WEXITSTATUS(status)};
}

/// The last lines of a file, of which not more than the last few KiB are read.
std::string last_lines(const fs::path& file, int lines) {
  constexpr std::uintmax_t kBytes = 4096;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size == 0) return "";
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(size - std::min(size, kBytes)));
  std::string text{std::istreambuf_iterator<char>(in), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::size_t from = text.size();
  for (int line = 0; line < lines && from != text.npos && from > 0; ++line) from = text.rfind('\n', from - 1);
  return from == text.npos || from == 0 ? text : text.substr(from + 1);
}

std::uintmax_t bytes_below(const fs::path& folder) {
  std::uintmax_t sum = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file()) sum += entry.file_size();
  }
  return sum;
}

void keep_only(Records<double>& records, const StageSet& stages) {
  if (!stages.has(Stage::matrices)) {
    records.matrices.clear();
    records.lights.clear();
  }
  if (!stages.has(Stage::vertex)) records.vertices.clear();
  if (!stages.has(Stage::light)) records.lit.clear();
  if (!stages.has(Stage::clip)) records.polygons = {};
  if (!stages.has(Stage::window)) records.triangles.clear();
  if (!stages.has(Stage::coverage)) records.covered.clear();
  if (!stages.has(Stage::depth)) records.depth.clear();
  if (!stages.has(Stage::attributes)) records.attributes.clear();
  if (!stages.has(Stage::shade)) records.shaded.clear();
  if (!stages.has(Stage::visibility)) records.drawn.clear();
}

class ProcessRenderer : public Renderer {
 public:
  explicit ProcessRenderer(ProcessSpec spec) : spec_(std::move(spec)) {}

  RendererInfo info() const override {
    RendererInfo info;
    info.name = spec_.name;
    info.version = spec_.version;
    for (std::size_t i = 0; i < kStageNames.size(); ++i) {
      const auto stage = static_cast<Stage>(i);
      info[stage].shows = spec_.shows.has(stage);
      if (!info[stage].shows) info[stage].reason = "not among the stages that it is said to show";
    }
    return info;
  }

  Capture capture(const Scene& scene, const Request& request) override {
    if (scene.path.empty()) {
      throw Unsupported(fmt::format("{}: a scene made in memory cannot be handed to a program", spec_.name));
    }
    if (scene.frame.antialias.kind != Antialias::Kind::none) {
      throw Unsupported(fmt::format("{}: the passes of an antialiased scene stand in no file", spec_.name));
    }
    require_budget(scene, plane_bytes(scene), request.memory_budget);
    const HeldSignals signals;
    const TemporaryFolder temporary;
    const fs::path folder = temporary.path() / "capture", log = temporary.path() / "stderr.txt";
    fs::create_directory(folder);

    std::vector<std::string> argv = spec_.argv;
    for (std::string& argument : argv) {
      argument =
          replaced(replaced(argument, "{folder}", folder.string()), "{scene}", fs::absolute(scene.path).string());
    }
    pid_t pid = 0;
    if (const int error = spawn(argv, merged_environment(spec_.environment), log, signals, pid); error != 0) {
      fail(argv, fmt::format("cannot be started: {}", std::strerror(error)), log);
    }
    const Ending ending = wait_for(pid, spec_.timeout, signals);
    if (ending.status == kUnsupportedStatus) {
      const std::string reason = last_lines(log, 1);
      throw Unsupported(reason.empty() ? fmt::format("{}: {}, and gave no reason", spec_.name, ending.words) : reason);
    }
    if (!ending.words.empty()) fail(argv, ending.words, log);
    if (!fs::is_directory(folder)) fail(argv, "left no capture: its folder is gone", log);
    require_budget(scene, bytes_below(folder), request.memory_budget);
    try {
      Capture capture = read_capture(folder);
      if (capture.width != scene.frame.width || capture.height != scene.frame.height) {
        fail(argv,
             fmt::format("left a capture of {} x {} pixels where the scene has {} x {}", capture.width, capture.height,
                         scene.frame.width, scene.frame.height),
             log);
      }
      keep_only(capture.records, request.records);
      capture.renderer = spec_.name;
      return capture;
    } catch (const CaptureError& error) {
      fail(argv, fmt::format("left no capture that can be read: {}", error.what()), log);
    }
  }

 private:
  [[noreturn]] void fail(const std::vector<std::string>& argv, std::string_view what, const fs::path& log) const {
    constexpr int kLines = 10;
    const std::string lines = last_lines(log, kLines);
    throw RendererFailed(fmt::format("{}: {} {}{}{}", spec_.name, fmt::join(argv, " "), what,
                                     lines.empty() ? "" : "\nthe end of its stderr:\n", lines));
  }

  ProcessSpec spec_;
};

}  // namespace

std::unique_ptr<Renderer> make_process_renderer(ProcessSpec spec) {
  if (spec.argv.empty() || spec.argv[0].empty()) {
    throw std::invalid_argument(fmt::format("{}: expected a program to run, found none", spec.name));
  }
  return std::make_unique<ProcessRenderer>(std::move(spec));
}

}  // namespace plumbline

#include "base/supervise.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace plumbline {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSlots = 1024;
constexpr std::size_t kLongestPath = 4096;  // PATH_MAX
constexpr int kHoldMs = 60'000;

enum class SlotState : int { free, filling, tree, empty_folder };

/// Memory that the supervisor shares with the program and all its forks. The states stand together: a page of memory
/// costs a page fault when its first byte is touched, some 10 us, and few paths are ever written.
struct Shared {
  std::array<std::atomic<SlotState>, kSlots> states{};  ///< all free
  std::atomic<int> held{0};                             ///< EndsLater objects
  std::array<char[kLongestPath], kSlots> paths;         ///< a slot's, unless it is free
};

/// Null where nobody supervises.
Shared*& shared() {
  static Shared* memory = nullptr;
  return memory;
}

// kill_children() runs after a fork() of a process with threads, one of which may hold malloc()'s lock: nothing here
// takes memory.

/// A process' parent by its folder in /proc, or 0.
pid_t parent_of(int proc, const char* process) {
  const int folder = ::openat(proc, process, O_PATH | O_DIRECTORY | O_CLOEXEC),
            file = folder < 0 ? -1 : ::openat(folder, "stat", O_RDONLY | O_CLOEXEC);
  std::array<char, 512> bytes;
  const ssize_t got = file < 0 ? 0 : ::read(file, bytes.data(), bytes.size());
  for (const int opened : {folder, file}) {
    if (opened >= 0) ::close(opened);
  }
  const std::string_view stat(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  const std::size_t name_end = stat.rfind(')');  // the name before it may hold anything
  if (name_end == stat.npos || name_end + 4 >= stat.size()) return 0;
  pid_t parent = 0;
  std::from_chars(stat.data() + name_end + 4, stat.data() + stat.size(), parent);
  return parent;
}

/// Calls visit(pid_t) for each child of this process; none without a /proc.
template <class Visit>
void each_child(Visit visit) {
  const int proc = ::open("/proc", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (proc < 0) return;
  alignas(dirent64) std::array<char, 8192> entries;
  for (ssize_t got; (got = ::getdents64(proc, entries.data(), entries.size())) > 0;) {
    for (ssize_t at = 0; at < got;) {
      const auto* entry = reinterpret_cast<const dirent64*>(&entries[static_cast<std::size_t>(at)]);
      at += entry->d_reclen;
      const std::string_view name(entry->d_name);
      pid_t pid = 0;
      if (std::from_chars(name.data(), name.data() + name.size(), pid).ptr != name.data() + name.size()) continue;
      if (parent_of(proc, entry->d_name) == ::getpid()) visit(pid);
    }
  }
  ::close(proc);
}

void remove_registered(Shared& memory) {
  std::error_code ignored;
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    if (memory.states[slot] == SlotState::tree) fs::remove_all(memory.paths[slot], ignored);
  }
  for (std::size_t slot = kSlots; slot-- > 0;) {  // the innermost first
    if (memory.states[slot] == SlotState::empty_folder) ::rmdir(memory.paths[slot]);
  }
}

void sleep_ms(int ms) {
  const timespec pause{0, ms * 1'000'000L};
  ::nanosleep(&pause, nullptr);
}

/// Waits for the program's end. Returns its wait status, and the signal that ends the supervisor, or 0.
std::pair<int, int> wait_for_program(pid_t program, const sigset_t& waited, const Shared& memory) {
  int ended_by = 0, status = 0;
  while (true) {
    const int signal = ::sigwaitinfo(&waited, nullptr);
    if (signal > 0 && signal != SIGCHLD && ended_by == 0) {
      ended_by = signal;
      for (int ms = 0; memory.held > 0 && ms < kHoldMs; ms += 2) sleep_ms(2);
      ::kill(program, SIGKILL);
    }
    pid_t ended;
    while ((ended = ::waitpid(-1, &status, WNOHANG)) > 0) {
      if (ended == program) return {status, ended_by};
    }
    if (ended < 0 && errno == ECHILD) return {status, ended_by};  // cannot be, for the program is a child
  }
}

[[noreturn]] void end_by(int signal) {
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  ::signal(signal, SIG_DFL);
  sigset_t one;
  ::sigemptyset(&one);
  ::sigaddset(&one, signal);
  ::sigprocmask(SIG_UNBLOCK, &one, nullptr);
  ::raise(signal);
  ::_exit(128 + signal);
}

}  // namespace

void kill_children() {
  // The children of what is killed become ours, so that each round finds the next generation.
  for (int unseen = 0; unseen < 1000 && ::waitpid(-1, nullptr, WNOHANG) >= 0;) {
    bool any = false;
    each_child([&any](pid_t child) { any = ::kill(child, SIGKILL) == 0 || any; });
    if (any) {
      ::waitpid(-1, nullptr, 0);
    } else {  // not in /proc yet, or there is no /proc
      ++unseen;
      sleep_ms(1);
    }
  }
}

void supervise() {
  void* pages =
      ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED) return;
  Shared* memory = new (pages) Shared;
  sigset_t ends, waited, before;
  ::sigemptyset(&ends);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action;
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) ::sigaddset(&ends, signal);
  }
  waited = ends;
  ::sigaddset(&waited, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &waited, &before);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  std::fflush(nullptr);
  const pid_t parent = ::getpid(), program = ::fork();
  if (program < 0) {
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    ::munmap(pages, sizeof(Shared));
    return;
  }
  if (program == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
    ::sigprocmask(SIG_SETMASK, &before, nullptr);
    ::sigprocmask(SIG_BLOCK, &ends, nullptr);  // the supervisor hears them
    shared() = memory;
    return;
  }
  const auto [status, ended_by] = wait_for_program(program, waited, *memory);
  kill_children();
  remove_registered(*memory);
  if (ended_by != 0) end_by(ended_by);
  if (WIFSIGNALED(status)) end_by(WTERMSIG(status));
  ::_exit(WEXITSTATUS(status));
}

RemovedAtEnd::RemovedAtEnd(const fs::path& path, What what) : slot_(-1) {
  Shared* memory = shared();
  const std::string& name = path.native();
  if (memory == nullptr || name.size() >= kLongestPath) return;
  for (std::size_t slot = 0; slot < kSlots; ++slot) {
    SlotState expected = SlotState::free;
    if (!memory->states[slot].compare_exchange_strong(expected, SlotState::filling)) continue;
    std::memcpy(memory->paths[slot], name.c_str(), name.size() + 1);
    memory->states[slot] = what == What::tree ? SlotState::tree : SlotState::empty_folder;
    slot_ = static_cast<int>(slot);
    return;
  }
}

RemovedAtEnd::~RemovedAtEnd() {
  if (slot_ >= 0) shared()->states[static_cast<std::size_t>(slot_)] = SlotState::free;
}

RemovedAtEnd::RemovedAtEnd(RemovedAtEnd&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

EndsLater::EndsLater() {
  if (shared() != nullptr) ++shared()->held;
}
EndsLater::~EndsLater() {
  if (shared() != nullptr) --shared()->held;
}

}  // namespace plumbline

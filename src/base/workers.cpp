#include "base/workers.h"

#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <new>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "base/process_limits.h"

namespace plumbline {

using std::chrono::milliseconds;

namespace {

std::int64_t now() {
  return std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

struct Progress::Shared {
  std::atomic<std::uint32_t> step = kBetween;
  std::atomic<std::int64_t> limit = 0, until = 0;  // [ms]
};

Progress::Progress() {
  void* page = ::mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (page == MAP_FAILED) throw std::bad_alloc();
  shared_ = new (page) Shared;
}
Progress::~Progress() { ::munmap(shared_, sizeof(Shared)); }

void Progress::begin(std::uint32_t step, milliseconds limit) {
  shared_->limit = limit.count();
  shared_->until = now() + limit.count();
  shared_->step = step;
}
std::uint32_t Progress::step() const { return shared_->step; }
milliseconds Progress::limit() const { return milliseconds(shared_->limit); }
milliseconds Progress::left() const { return milliseconds(shared_->until - now()); }

namespace {

constexpr int kMostAttempts = 100;

// A message: its length, then its bytes. False: the other end is gone.
bool send_all(int to, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t sent = ::send(to, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}
bool send_message(int to, const std::string& bytes) {
  const std::uint64_t size = bytes.size();
  return send_all(to, reinterpret_cast<const char*>(&size), sizeof size) && send_all(to, bytes.data(), bytes.size());
}

// Appends what is there. False: the other end is gone.
bool receive_some(int from, std::string& bytes) {
  char buffer[1 << 16];
  ssize_t got;
  while ((got = ::recv(from, buffer, sizeof buffer, 0)) < 0 && errno == EINTR) {
  }
  if (got <= 0) return false;
  bytes.append(buffer, static_cast<std::size_t>(got));
  return true;
}
// Takes a message off the front, if it is whole.
std::optional<std::string> take_message(std::string& bytes) {
  std::uint64_t size = 0;
  if (bytes.size() < sizeof size) return std::nullopt;
  std::memcpy(&size, bytes.data(), sizeof size);
  if (bytes.size() < sizeof size + size) return std::nullopt;
  std::string out = bytes.substr(sizeof size, size);
  bytes.erase(0, sizeof size + size);
  return out;
}

// Memory was refused, or address space for a library.
bool lacks_memory(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         std::strstr(error.what(), "failed to map segment") != nullptr;
}

[[noreturn]] void be_worker(int socket, const WorkerLimits& limits, Progress& progress,
                            const std::function<Workers::Answer(Progress&)>& make) {
  leave_no_core();
  limit_memory(limits.memory);
  // exit() in a renderer runs none of the handlers that the parent registered: they may wait for the parent's threads.
  ::on_exit([](int status, void*) { ::_exit(status); }, nullptr);
  Workers::Answer answer;
  std::string received;
  while (true) {
    std::optional<std::string> request;
    while (!(request = take_message(received))) {
      if (!receive_some(socket, received)) _exit(0);
    }
    std::string reply;
    try {
      if (!answer) answer = make(progress);
      reply = "+" + answer(*request);
    } catch (const std::exception& error) {
      reply = std::string("-") + error.what();
      if (lacks_memory(error)) reply += fmt::format(" (a worker's memory is limited to {} MiB)", limits.memory >> 20);
    }
    if (!send_message(socket, reply)) _exit(0);
  }
}

std::string how_ended(int status, bool hung, milliseconds limit) {
  if (hung) return fmt::format("took longer than {} and was killed", std::chrono::duration<double>(limit));
  if (WIFSIGNALED(status)) {
    return fmt::format("was killed by signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
  }
  return fmt::format("ended its process with status {}", WEXITSTATUS(status));
}

}  // namespace

struct Workers::Worker {
  pid_t pid = -1;
  int socket = -1;
  Progress progress;
  std::string received;
  std::optional<std::size_t> job;
  bool hung = false;
};

struct Workers::Run {
  std::vector<Worker> workers;
  WorkerLimits limits;
  std::function<Answer(Progress&)> make;

  void start(Worker& worker) {
    int ends[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
      throw std::runtime_error(fmt::format("no socket for a worker process: {}", std::strerror(errno)));
    }
    worker.progress.end(limits.step);
    worker.hung = false;
    worker.received.clear();
    const pid_t parent = ::getpid();
    std::fflush(nullptr);
    worker.pid = ::fork();
    if (worker.pid == 0) {
      ::prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (::getppid() != parent) _exit(0);
      for (const Worker& other : workers) {
        if (other.socket >= 0) ::close(other.socket);
      }
      ::close(ends[0]);
      be_worker(ends[1], limits, worker.progress, make);
    }
    ::close(ends[1]);
    worker.socket = ends[0];
    if (worker.pid < 0) {
      ::close(std::exchange(worker.socket, -1));
      throw std::runtime_error(fmt::format("no worker process: {}", std::strerror(errno)));
    }
  }

  // Waits for the end of a worker, which is near.
  static int reap(Worker& worker) {
    int status = 0;
    while (::waitpid(worker.pid, &status, 0) < 0 && errno == EINTR) {
    }
    ::close(std::exchange(worker.socket, -1));
    worker.pid = -1;
    return status;
  }

  ~Run() {
    for (Worker& worker : workers) {
      if (worker.pid > 0) ::kill(worker.pid, SIGKILL);
    }
    for (Worker& worker : workers) {
      if (worker.pid > 0) reap(worker);
    }
  }

  // Until one of the workers has something to say, or takes too long.
  void wait() {
    std::vector<pollfd> files;
    milliseconds most{60'000};
    for (const Worker& worker : workers) {
      files.push_back({worker.job ? worker.socket : -1, POLLIN, 0});
      if (worker.job) most = std::min(most, worker.progress.left());
    }
    const auto pause =
        std::clamp<std::int64_t>(most.count() + 1, 1, 1000);  // a step that begins has a limit of its own
    if (::poll(files.data(), files.size(), static_cast<int>(pause)) < 0 && errno != EINTR) {
      throw std::runtime_error(fmt::format("worker processes: {}", std::strerror(errno)));
    }
    for (std::size_t i = 0; i < workers.size(); ++i) {
      Worker& worker = workers[i];
      readable_[i] = worker.job && files[i].revents != 0;
      if (!worker.job || readable_[i] || worker.hung || worker.progress.left() >= milliseconds(0)) continue;
      worker.hung = true;  // its socket may stay open in a process that it has begun
      readable_[i] = 1;
      ::kill(worker.pid, SIGKILL);
    }
  }

  void run(const WorkerJobs& jobs);

 private:
  std::vector<char> readable_;
};

void Workers::Run::run(const WorkerJobs& jobs) {
  struct Job {
    std::string request;
    std::optional<std::string> answer;
    int attempts = 0;
  };
  const std::size_t n = jobs.order.size();
  std::vector<Job> all(n);
  std::vector<std::size_t> again;  // whose worker ended
  std::size_t next = 0, taken = 0, end = n;
  readable_.assign(workers.size(), 0);
  const auto next_job = [&]() -> std::optional<std::size_t> {
    if (!again.empty()) {
      const std::size_t job = again.back();
      again.pop_back();
      return job;
    }
    while (next < n && jobs.order[next] >= end) ++next;
    if (next == n) return std::nullopt;
    const std::size_t job = jobs.order[next++];
    all[job].request = jobs.request(job);
    return job;
  };
  while (taken < n) {
    for (Worker& worker : workers) {
      if (worker.job || !(worker.job = next_job())) continue;
      if (worker.pid < 0) start(worker);
      worker.progress.end(limits.step);
      send_message(worker.socket, all[*worker.job].request);  // one that is gone is seen below
    }
    wait();
    for (std::size_t i = 0; i < workers.size(); ++i) {
      if (!readable_[i]) continue;
      Worker& worker = workers[i];
      const std::size_t number = worker.job.value();
      Job& job = all[number];
      if (!worker.hung && receive_some(worker.socket, worker.received)) {
        if (!(job.answer = take_message(worker.received))) continue;
        if (job.answer->front() == '-') end = std::min(end, number);
      } else {
        const std::uint32_t step = worker.progress.step();
        const int status = reap(worker);
        const WorkerEnd ended{step, how_ended(status, worker.hung, worker.progress.limit()),
                              !worker.hung && WIFSIGNALED(status) ? WTERMSIG(status) : 0};
        if (++job.attempts > kMostAttempts) throw std::runtime_error("the worker process " + ended.how);
        job.request = jobs.ask_again(number, ended);
        again.push_back(number);
      }
      worker.job.reset();
    }
    for (; taken < n && all[taken].answer; ++taken) {
      std::string answer = *std::exchange(all[taken].answer, std::nullopt);
      if (answer.front() == '-') throw std::runtime_error(answer.substr(1));
      jobs.take(taken, answer.substr(1));
    }
  }
}

Workers::Workers(std::size_t count, const WorkerLimits& limits, std::function<Answer(Progress&)> make)
    : run_(std::make_unique<Run>()) {
  run_->workers = std::vector<Worker>(std::max<std::size_t>(count, 1));
  run_->limits = limits;
  run_->make = std::move(make);
}
Workers::~Workers() = default;

void Workers::run(const WorkerJobs& jobs) { run_->run(jobs); }

}  // namespace plumbline

// Processes that are kept warm and answer one request after another. A crash, a hang or a lack of memory ends one
// worker; its parent reads at which step, and starts another.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace plumbline {

/// The step that a worker is at, in memory that it shares with its parent.
class Progress {
 public:
  static constexpr std::uint32_t kBetween = 0;  ///< between two steps

  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Begins a step, any number but kBetween; end() begins the time between two steps. Each may take `limit`.
  void begin(std::uint32_t step, std::chrono::milliseconds limit);
  void end(std::chrono::milliseconds limit) { begin(kBetween, limit); }
  std::uint32_t step() const;
  /// The step's limit, and the time left of it; negative: it is over.
  std::chrono::milliseconds limit() const;
  std::chrono::milliseconds left() const;

 private:
  struct Shared;
  Shared* shared_;
};

struct WorkerLimits {
  std::chrono::milliseconds step{300'000};         ///< a step, or what stands between two, may take
  std::uint64_t memory = std::uint64_t{12} << 30;  ///< address space beyond the parent's own [bytes]
};

/// The end of a worker that did not answer.
struct WorkerEnd {
  std::uint32_t step = Progress::kBetween;
  std::string how;  ///< such as "was killed by signal 11 (Segmentation fault)"
  int signal = 0;   ///< that killed it, before its step's limit; 0: none
};

/// Requests 0 to n - 1: the order in which they begin (a permutation), their bytes, and the receiver of the answers.
struct WorkerJobs {
  std::span<const std::size_t> order;
  std::function<std::string(std::size_t)> request;
  std::function<void(std::size_t, std::string answer)> take;            ///< called in order of numbers, from 0 on
  std::function<std::string(std::size_t, const WorkerEnd&)> ask_again;  ///< the request for the next worker
};

/// Workers are copies (fork) of a parent that must have no threads. The kernel kills them when the parent ends, however
/// it ends.
class Workers {
 public:
  using Answer = std::function<std::string(const std::string& request)>;
  /// make(progress) is called in each worker once, before its first request.
  Workers(std::size_t count, const WorkerLimits& limits, std::function<Answer(Progress&)> make);
  ~Workers();

  /// Runs all requests. An exception of a worker becomes a std::runtime_error of the same words, thrown when its number
  /// is next to be taken; nothing with a greater number begins after it. Throws std::runtime_error, too, where one
  /// request ends more than 100 workers.
  void run(const WorkerJobs& jobs);

 private:
  struct Worker;
  struct Run;
  std::unique_ptr<Run> run_;
};

}  // namespace plumbline

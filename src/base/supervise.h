// The end of a program: whatever signal comes, nothing of it is left behind.
#pragma once

#include <atomic>
#include <filesystem>

namespace plumbline {

/// Splits the process in two. The child returns from this call and is the program. The parent, the supervisor, waits
/// for the child's end and ends likewise: by the same exit status or signal. SIGINT, SIGTERM and SIGHUP end the child
/// at once, unless the caller of this program ignores them. Before the supervisor ends, it kills all descendants, those
/// in sessions of their own too, and removes what RemovedAtEnd names. After SIGKILL of the supervisor the kernel kills
/// the child. Call it first in main(), before there are threads.
void supervise();

/// Kills all children of this process, and theirs, and waits for their end. A process must be a child subreaper
/// (prctl) to have those of its descendants whose parents have ended.
void kill_children();

/// A path that the supervisor removes where the program ends while this object lives. No effect without a supervisor,
/// and beyond 1,024 objects.
class RemovedAtEnd {
 public:
  enum class What { tree, empty_folder };  ///< empty_folder: if nothing is in it
  RemovedAtEnd(const std::filesystem::path& path, What what);
  ~RemovedAtEnd();
  RemovedAtEnd(RemovedAtEnd&& other) noexcept;
  RemovedAtEnd& operator=(RemovedAtEnd&&) = delete;

 private:
  int slot_;  ///< -1: none
};

/// While one lives, SIGINT, SIGTERM and SIGHUP wait, up to 60 s: for several writes that belong together.
class EndsLater {
 public:
  EndsLater();
  ~EndsLater();
  EndsLater(const EndsLater&) = delete;
  EndsLater& operator=(const EndsLater&) = delete;
};

}  // namespace plumbline

// Files and folders that do not outlive the program.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/supervise.h"

namespace plumbline {

/// The folder for temporary files: $TMPDIR; without it /dev/shm, whose files lie in memory, if 2 GiB are free there;
/// else /tmp. A disk's file system takes time over many small files: ext4 looks for an inode that was not freed in the
/// last 5 s. Throws std::runtime_error, which names $TMPDIR, where that is no folder.
std::filesystem::path temporary_files();
/// Makes a folder there, and removes it. Throws std::runtime_error, which names the folder, where that fails.
void require_temporary_files();

/// A new file, or a new folder, of a hidden name, which its destructor removes with all that is in it. Where the
/// program ends before: the supervisor removes it (supervise.h), or after SIGKILL the next TemporaryPath that is made
/// with the same prefix in the same folder.
class TemporaryPath {
 public:
  enum class Kind { file, folder, private_folder };  ///< modes 0666 and 0777 less the umask; 0700
  /// `prefix` begins the name; a process' number and a time follow. Throws std::system_error.
  TemporaryPath(const std::filesystem::path& folder, std::string_view prefix, Kind kind);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return held_.path; }
  /// A descriptor of the file, to write by, or of the folder. While it is open, it holds a lock that says so.
  int descriptor() const { return held_.descriptor; }

 private:
  struct Held {
    std::filesystem::path path;
    RemovedAtEnd removed;
    int descriptor = -1;
  };
  static Held make(const std::filesystem::path& folder, std::string_view prefix, Kind kind);

  Held held_;
};

}  // namespace plumbline

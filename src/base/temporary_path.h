// Files and folders that do not outlive the program.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/supervise.h"

namespace plumbline {

/// The folder for temporary files: the first that is set of $TMPDIR, $TMP, $TEMP, $TEMPDIR; else /dev/shm, if that is a
/// tmpfs with 2 GiB free; else /tmp. (Many small files are slow on disk: ext4 looks for an inode that was not freed in
/// the last 5 s.) Throws std::runtime_error, which names $TMPDIR, where the variable names no folder.
std::filesystem::path temporary_files();
/// Throws std::runtime_error, which names the folder, unless a folder can be made in temporary_files().
void require_temporary_files();

/// A new file, or a new folder, of a hidden name, which its destructor removes with all that is in it. Where the
/// program ends before: the supervisor removes it (supervise.h), or after SIGKILL the next TemporaryPath that is made
/// with the same prefix in the same folder.
class TemporaryPath {
 public:
  enum class Kind { file, folder, private_folder };  ///< modes 0666 and 0777 less the umask; 0700
  /// `prefix` begins the name; a thread's number and a time follow. Throws std::system_error.
  TemporaryPath(const std::filesystem::path& folder, std::string_view prefix, Kind kind);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return held_.path; }
  /// Descriptor of the file, open for writing, or of the folder. It holds the lock (flock) of a path in use.
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

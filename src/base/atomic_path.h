// Files and folders that appear whole or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "base/temporary_path.h"

namespace plumbline {

/// The message is: path: cannot be written: reason.
struct OutputError : std::runtime_error {
  OutputError(const std::filesystem::path& path, std::string_view reason);
};

/// Where a write to `path` arrives: absolute, every link followed, the last one even where it points to nothing yet.
/// Throws OutputError, as all below do.
std::filesystem::path resolved(const std::filesystem::path& path);

/// A file or folder under a hidden name beside the target; commit() renames it to the target. Without a commit,
/// whatever was written is removed, also where the program is killed (base/temporary_path.h). A link as the target
/// stays, what it points to is replaced.
class AtomicPath {
 public:
  explicit AtomicPath(const std::filesystem::path& target);
  ~AtomicPath();
  AtomicPath(const AtomicPath&) = delete;
  AtomicPath& operator=(const AtomicPath&) = delete;

  /// Makes it a file of these bytes.
  void write(std::string_view bytes);
  /// Makes it a folder, and the folders above it.
  void make_folder();
  /// Makes a file in the folder that it is, and the folders between.
  void write_inside(const std::filesystem::path& name, std::string_view bytes);
  /// A file replaces a regular file that may be written, never a folder or a device; a folder replaces a folder, even
  /// one that is not empty.
  void commit();

 private:
  /// A folder above the target that was not there before.
  struct MadeFolder {
    std::filesystem::path path;
    RemovedAtEnd removed;
  };

  void require_file() const;
  void require_folder() const;
  void replace_folder();

  std::filesystem::path named_, target_;
  std::vector<MadeFolder> made_;  ///< the outermost first
  std::optional<TemporaryPath> temporary_;
  bool is_folder_ = false;
};

/// Tries, before any work, whether a file could be written there, and leaves nothing behind.
void require_writable_file(const std::filesystem::path& file);
/// The same of a folder, which may hold no file but those named, relative to it: nobody else's work is replaced.
void require_writable_folder(const std::filesystem::path& folder, const std::set<std::filesystem::path>& may_hold);

struct OutputFile {
  std::filesystem::path path;
  std::string_view bytes;
};
/// All of the files are written before the first of them appears: all appear or, on failure, none.
void write_files(std::span<const OutputFile> files);
void write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace plumbline

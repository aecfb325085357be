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

/// Absolute path that a write to `path` reaches, with every link followed, a dangling last one too. Throws OutputError,
/// as all functions below do.
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

  /// Writes the bytes to a hidden file.
  void write(std::string_view bytes);
  /// Makes a hidden folder, and the folders above the target.
  void make_folder();
  /// After make_folder(): writes a file in the hidden folder, and makes the folders between.
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

/// Throws unless the file can be written; leaves nothing behind. To be called before the work.
void require_writable_file(const std::filesystem::path& file);
/// Throws unless the folder can be replaced; leaves nothing behind. The folder may hold no files but `may_hold`,
/// relative to the folder: nobody else's work is replaced.
void require_writable_folder(const std::filesystem::path& folder, const std::set<std::filesystem::path>& may_hold);

struct OutputFile {
  std::filesystem::path path;
  std::string_view bytes;
};
/// Writes all files before the first of them appears: where a write fails, none appears. A rename that fails leaves the
/// files renamed before.
void write_files(std::span<const OutputFile> files);
void write_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace plumbline

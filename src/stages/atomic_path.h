// Files and folders that appear whole or not at all.
#pragma once

#include <filesystem>

namespace plumbline {

/// A hidden name beside `target`, with its ending, to write to; commit() renames it to the target. Without a commit
/// whatever was written is removed.
class AtomicPath {
 public:
  explicit AtomicPath(const std::filesystem::path& target);
  ~AtomicPath();
  AtomicPath(const AtomicPath&) = delete;
  AtomicPath& operator=(const AtomicPath&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// A file replaces a regular file, never a folder or a device; a folder replaces a folder, even one that is not
  /// empty. Throws std::filesystem::filesystem_error.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
};

}  // namespace plumbline

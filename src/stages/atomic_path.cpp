#include "stages/atomic_path.h"

#include <unistd.h>

#include <chrono>

#include <fmt/format.h>

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// A name that no other process or call uses.
fs::path beside(const fs::path& target) {
  const auto ticks = std::chrono::steady_clock::now().time_since_epoch().count();
  return target.parent_path() /
         fmt::format(".{}.tmp-{}-{}{}", target.stem().string(), ::getpid(), ticks, target.extension().string());
}

}  // namespace

AtomicPath::AtomicPath(const fs::path& target) : target_(fs::absolute(target).lexically_normal()) {
  if (!target_.has_filename()) target_ = target_.parent_path();  // "folder/"
  path_ = beside(target_);
}

AtomicPath::~AtomicPath() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void AtomicPath::commit() {
  const bool writes_folder = fs::is_directory(path_);
  if (fs::exists(target_) && (writes_folder ? !fs::is_directory(target_) : !fs::is_regular_file(target_))) {
    throw fs::filesystem_error(writes_folder ? "it is no folder" : "it is no regular file", target_,
                               std::make_error_code(std::errc::file_exists));
  }
  if (!writes_folder || !fs::exists(target_)) return fs::rename(path_, target_);
  const fs::path old = beside(target_);
  fs::rename(target_, old);
  fs::rename(path_, target_);
  fs::remove_all(old);
}

}  // namespace plumbline

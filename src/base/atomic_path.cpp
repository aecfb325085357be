#include "base/atomic_path.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = ".plumb-";

/// Turns the errors of <filesystem>, which name other paths than the user did, into ours.
template <class Act>
auto reported(const fs::path& named, Act act) {
  try {
    return act();
  } catch (const std::system_error& error) {  // a filesystem_error too
    throw OutputError(named, error.code().message());
  }
}

void write_all(int file, const fs::path& named, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written >= 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    if (written < 0 && errno != EINTR) throw OutputError(named, std::strerror(errno));
  }
}

void make_file(const fs::path& path, const fs::path& named, std::string_view bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) throw OutputError(named, std::strerror(errno));
  try {
    write_all(file, named, bytes);
  } catch (...) {
    ::close(file);
    throw;
  }
  if (::close(file) != 0) throw OutputError(named, std::strerror(errno));
}

}  // namespace

OutputError::OutputError(const fs::path& path, std::string_view reason)
    : std::runtime_error(fmt::format("{}: cannot be written: {}", path.string(), reason)) {}

fs::path resolved(const fs::path& path) {
  constexpr int kMostLinks = 40;  // as Linux follows
  if (path.empty()) throw OutputError(path, "the name is empty");
  return reported(path, [&] {
    fs::path at = fs::absolute(path);
    if (!at.has_filename()) at = at.parent_path();  // "folder/"
    for (int links = 0; fs::is_symlink(at); ++links) {
      if (links == kMostLinks) throw OutputError(path, std::strerror(ELOOP));
      at = at.parent_path() / fs::read_symlink(at);
    }
    if (at.filename() == "." || at.filename() == "..") return fs::weakly_canonical(at);
    return fs::weakly_canonical(at.parent_path()) / at.filename();
  });
}

AtomicPath::AtomicPath(const fs::path& target) : named_(target), target_(resolved(target)) {}

AtomicPath::~AtomicPath() {
  temporary_.reset();
  std::error_code ignored;
  while (!made_.empty()) {  // those that stayed empty
    fs::remove(made_.back().path, ignored);
    made_.pop_back();
  }
}

void AtomicPath::require_file() const {
  const fs::file_status status = fs::status(target_);
  if (fs::is_directory(status) || !named_.has_filename()) throw OutputError(named_, std::strerror(EISDIR));
  if (!fs::exists(status)) return;
  if (!fs::is_regular_file(status)) throw OutputError(named_, "it is no regular file");
  if (::access(target_.c_str(), W_OK) != 0) throw OutputError(named_, std::strerror(errno));
}

void AtomicPath::require_folder() const {
  if (fs::exists(target_) && !fs::is_directory(target_)) throw OutputError(named_, std::strerror(ENOTDIR));
}

void AtomicPath::write(std::string_view bytes) {
  reported(named_, [&] {
    require_file();
    temporary_.emplace(target_.parent_path(), kPrefix, TemporaryPath::Kind::file);
    write_all(temporary_->descriptor(), named_, bytes);
    const fs::file_status old = fs::status(target_);
    if (fs::exists(old)) fs::permissions(temporary_->path(), old.permissions());  // what is private stays so
  });
}

void AtomicPath::write_inside(const fs::path& name, std::string_view bytes) {
  const fs::path file = temporary_->path() / name;
  reported(named_ / name, [&] { fs::create_directories(file.parent_path()); });
  make_file(file, named_ / name, bytes);
}

void AtomicPath::make_folder() {
  is_folder_ = true;
  reported(named_, [&] {
    require_folder();
    std::vector<fs::path> missing;
    for (fs::path above = target_.parent_path(); !fs::exists(above); above = above.parent_path())
      missing.push_back(above);
    std::reverse(missing.begin(), missing.end());
    for (const fs::path& folder : missing) {
      RemovedAtEnd removed(folder, RemovedAtEnd::What::empty_folder);  // before it is there
      if (fs::create_directory(folder)) made_.push_back({folder, std::move(removed)});
    }
    temporary_.emplace(target_.parent_path(), kPrefix, TemporaryPath::Kind::folder);
  });
}

/// The old folder takes the temporary one's name in the same moment, and is removed with it.
void AtomicPath::replace_folder() {
  const fs::path& path = temporary_->path();
  if (::renameat2(AT_FDCWD, path.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) throw std::system_error(errno, std::generic_category());
  const EndsLater whole;  // a file system that cannot exchange: two renames
  const TemporaryPath old(target_.parent_path(), kPrefix, TemporaryPath::Kind::folder);
  fs::rename(target_, old.path());
  try {
    fs::rename(path, target_);
  } catch (...) {
    fs::rename(old.path(), target_);
    throw;
  }
}

void AtomicPath::commit() {
  reported(named_, [&] {
    is_folder_ ? require_folder() : require_file();
    if (is_folder_ && fs::exists(target_)) {
      replace_folder();
    } else {
      fs::rename(temporary_->path(), target_);
    }
    made_.clear();
    temporary_.reset();
  });
}

void require_writable_file(const fs::path& file) { AtomicPath(file).write(""); }

void require_writable_folder(const fs::path& folder, const std::set<fs::path>& may_hold) {
  AtomicPath(folder).make_folder();
  reported(folder, [&] {
    const fs::path target = resolved(folder);
    if (!fs::exists(target)) return;
    if (::access(target.c_str(), W_OK) != 0) throw OutputError(folder, std::strerror(errno));
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(target)) {
      if (fs::is_directory(entry.symlink_status())) continue;
      const fs::path file = entry.path().lexically_relative(target);
      if (may_hold.contains(file)) continue;
      throw OutputError(folder,
                        fmt::format("the folder holds what plumb did not write ({}); it is left alone", file.string()));
    }
  });
}

void write_files(std::span<const OutputFile> files) {
  std::vector<std::unique_ptr<AtomicPath>> written;
  for (const OutputFile& file : files) {
    written.push_back(std::make_unique<AtomicPath>(file.path));
    written.back()->write(file.bytes);
  }
  const EndsLater all;
  for (const auto& file : written) file->commit();
}

void write_file(const fs::path& file, std::string_view bytes) {
  const OutputFile one[] = {{file, bytes}};
  write_files(one);
}

}  // namespace plumbline

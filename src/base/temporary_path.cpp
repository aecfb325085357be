#include "base/temporary_path.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace plumbline {

namespace {

namespace fs = std::filesystem;

/// Whether the path still leads to what is open: another process may have removed it before it was locked.
bool leads_to(const fs::path& path, int descriptor) {
  struct stat at, open;
  return ::lstat(path.c_str(), &at) == 0 && ::fstat(descriptor, &open) == 0 && at.st_ino == open.st_ino &&
         at.st_dev == open.st_dev;
}

/// Prefix, number, hyphen, number.
bool is_temporary(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix)) return false;
  name.remove_prefix(prefix.size());
  const std::size_t hyphen = name.find('-');
  return hyphen != name.npos && hyphen > 0 && hyphen + 1 < name.size() &&
         std::ranges::all_of(name, [](char c) { return (c >= '0' && c <= '9') || c == '-'; });
}

/// Removes what a program left that was killed: nobody holds its lock.
void remove_abandoned(const fs::path& folder, std::string_view prefix) {
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (!is_temporary(entry->path().filename().string(), prefix)) continue;
    const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) continue;
    struct stat status;
    const bool is_own = ::fstat(descriptor, &status) == 0 && status.st_uid == ::geteuid() &&
                        (S_ISREG(status.st_mode) || S_ISDIR(status.st_mode));
    if (is_own && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && leads_to(entry->path(), descriptor)) {
      std::error_code ignored;
      fs::remove_all(entry->path(), ignored);
    }
    ::close(descriptor);
  }
}

constexpr const char* kMemory = "/dev/shm";  // tmpfs(5)

bool is_roomy_memory(const char* folder) {
  constexpr std::uint64_t kRoom = std::uint64_t{2} << 30;  // four captures of the largest budget [bytes]
  struct statfs of = {};
  return ::statfs(folder, &of) == 0 && of.f_type == TMPFS_MAGIC && ::access(folder, W_OK | X_OK) == 0 &&
         static_cast<std::uint64_t>(of.f_bavail) * static_cast<std::uint64_t>(of.f_bsize) >= kRoom;
}

}  // namespace

fs::path temporary_files() {
  // Variables that std::filesystem::temp_directory_path() reads.
  constexpr const char* kVariables[] = {"TMPDIR", "TMP", "TEMP", "TEMPDIR"};
  const bool is_said = std::ranges::any_of(kVariables, [](const char* name) { return std::getenv(name) != nullptr; });
  if (!is_said && is_roomy_memory(kMemory)) return kMemory;
  std::error_code error;
  fs::path out = fs::temp_directory_path(error);
  if (!error) return out;
  const char* said = std::getenv("TMPDIR");
  throw std::runtime_error(
      fmt::format("TMPDIR: {}: expected a folder for temporary files: {}", said ? said : "", error.message()));
}

void require_temporary_files() {
  const fs::path in = temporary_files();
  try {
    const TemporaryPath made(in, "plumbline-", TemporaryPath::Kind::private_folder);
  } catch (const std::system_error& error) {
    throw std::runtime_error(fmt::format("{}: expected a folder for temporary files, in which folders can be made: {}",
                                         in.string(), error.code().message()));
  }
}

TemporaryPath::Held TemporaryPath::make(const fs::path& folder, std::string_view prefix, Kind kind) {
  remove_abandoned(folder, prefix);
  const bool is_folder = kind != Kind::file;
  while (true) {
    const auto ticks = std::chrono::steady_clock::now().time_since_epoch().count();
    fs::path path = folder / fmt::format("{}{}-{}", prefix, ::gettid(), ticks);
    RemovedAtEnd removed(path, RemovedAtEnd::What::tree);  // before it is there
    if (is_folder && ::mkdir(path.c_str(), kind == Kind::private_folder ? 0700 : 0777) != 0) {
      if (errno == EEXIST) continue;
      throw std::system_error(errno, std::generic_category());
    }
    const int flags = is_folder ? O_RDONLY | O_DIRECTORY : O_WRONLY | O_CREAT | O_EXCL;
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      if (errno == EEXIST || (is_folder && errno == ENOENT)) continue;
      throw std::system_error(errno, std::generic_category());
    }
    const bool is_locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    if (is_locked && leads_to(path, descriptor)) return {std::move(path), std::move(removed), descriptor};
    ::close(descriptor);
  }
}

TemporaryPath::TemporaryPath(const fs::path& folder, std::string_view prefix, Kind kind)
    : held_(make(folder, prefix, kind)) {}

TemporaryPath::~TemporaryPath() {
  std::error_code ignored;
  fs::remove_all(held_.path, ignored);
  ::close(held_.descriptor);
}

}  // namespace plumbline

#include "cli/options/outputs.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "base/atomic_path.h"

namespace plumbline::cli {

namespace {

namespace fs = std::filesystem;

// One file, whatever links lead to it.
bool same(const fs::path& a, const fs::path& b) {
  std::error_code none;
  return resolved(a) == resolved(b) || fs::equivalent(a, b, none);
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  const fs::path inner = resolved(file), outer = resolved(folder);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

[[noreturn]] void refuse(const Output& output, const std::string& why) {
  throw std::runtime_error(fmt::format("{} {}: {}", output.option, output.path.string(), why));
}

}  // namespace

void require_outputs(std::span<const Output> files, const Output& folder, std::span<const fs::path> inputs) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Output& file = files[i];
    if (file.path.empty()) continue;
    for (const fs::path& input : inputs) {
      if (same(file.path, input)) refuse(file, "cannot be written: it is read by this run");
    }
    for (const Output& other : files.first(i)) {
      if (!other.path.empty() && same(file.path, other.path)) refuse(file, "is the file of " + other.option);
    }
    if (!folder.path.empty() && lies_in(file.path, folder.path)) {
      refuse(file, fmt::format("lies in the folder of {}, which is replaced", folder.option));
    }
    require_writable_file(file.path);
  }
}

void require_outside(const Output& folder, const Output& replaced) {
  if (folder.path.empty() || replaced.path.empty() || !lies_in(folder.path, replaced.path)) return;
  refuse(folder, fmt::format("lies in the folder of {}, which is replaced", replaced.option));
}

void require_folder(const Output& folder) {
  if (folder.path.empty()) return;
  fs::path there = resolved(folder.path);
  while (!fs::exists(there)) there = there.parent_path();
  if (!fs::is_directory(there)) refuse(folder, fmt::format("{} is not a folder", there.string()));
  if (::access(there.c_str(), W_OK | X_OK) != 0)
    refuse(folder, fmt::format("cannot be written: {}", std::strerror(errno)));
}

}  // namespace plumbline::cli

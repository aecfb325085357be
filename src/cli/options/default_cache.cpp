#include "cli/options/default_cache.h"

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

namespace plumbline::cli {

namespace {

namespace fs = std::filesystem;

fs::path absolute_path_in(const char* variable) {
  const char* text = std::getenv(variable);
  const fs::path path = text == nullptr ? "" : text;
  return path.is_absolute() ? path : fs::path();
}

}  // namespace

std::string default_cache() {
  if (const fs::path caches = absolute_path_in("XDG_CACHE_HOME"); !caches.empty()) return caches / "plumbline";
  const fs::path home = absolute_path_in("HOME");
  return home.empty() ? "" : home / ".cache" / "plumbline";
}

std::string made_cache(const std::string& folder) {
  if (folder.empty()) return "";
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder, error)) return folder;
  if (folder == default_cache()) return "";
  throw std::invalid_argument(fmt::format("--cache: {}: expected a folder, or a place for one", folder));
}

}  // namespace plumbline::cli

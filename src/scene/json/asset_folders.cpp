#include "scene/json/asset_folders.h"

#include <algorithm>

#include <fmt/format.h>

namespace plumbline {

namespace fs = std::filesystem;

bool AssetFolders::allow(const fs::path& file) const {
  std::error_code no_such;
  const fs::path real = fs::canonical(file, no_such);
  if (no_such) return false;
  return std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) {
    std::error_code unreadable;
    const fs::path root = fs::canonical(folder, unreadable);
    return !unreadable && std::mismatch(root.begin(), root.end(), real.begin(), real.end()).first == root.end();
  });
}

fs::path AssetFolders::find(const JsonNode& node, std::string_view what) const {
  const std::string& text = node.text();
  const fs::path name = text;
  if (name.is_absolute() || text.find('\0') != text.npos) {
    node.refuse(fmt::format("{}, as a path from the scene's folder or an asset folder", what));
  }
  std::string looked;
  for (const fs::path& folder : folders_) {
    const fs::path file = folder / name;
    std::error_code error;
    if (fs::is_directory(file, error)) node.refuse(what, fmt::format("the folder {}", file.string()));
    if (fs::exists(file, error)) {
      if (!allow(file)) {
        node.refuse("a file in the scene's folder or an asset folder (--assets), or below",
                    fmt::format("\"{}\", which leads out of it", text));
      }
      if (!fs::is_regular_file(file, error)) {
        node.refuse(what, fmt::format("{}, which is no regular file", file.string()));
      }
      return file;
    }
    if (fs::is_symlink(file, error)) node.refuse(what, fmt::format("{}, a link that leads nowhere", file.string()));
    looked += fmt::format("{}{}", looked.empty() ? "" : ", ", folder.string());
  }
  node.refuse(what, fmt::format("no file \"{}\" in {}", text, looked));
}

}  // namespace plumbline

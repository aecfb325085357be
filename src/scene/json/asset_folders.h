// Where a scene may read files from.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "scene/json/json_tree.h"

namespace plumbline {

/// A scene's own folder and the asset folders: what lies in them and below may be read, and nothing else, whatever
/// links or ".." a name goes through.
class AssetFolders {
 public:
  /// In the order in which files are looked for.
  explicit AssetFolders(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  bool allow(const std::filesystem::path& file) const;
  const std::vector<std::filesystem::path>& all() const { return folders_; }

  /// The file of the name that `node` holds, from the first folder that has it. `what` is what messages expect.
  /// Throws JsonError: absolute, no such file, none that may be read.
  std::filesystem::path find(const JsonNode& node, std::string_view what) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace plumbline

// Folders from which a scene may read files.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "scene/json/json_tree.h"

namespace plumbline {

/// A scene's own folder and the asset folders. Only files in or below these folders may be read; links and ".." are
/// resolved before the check.
class AssetFolders {
 public:
  /// `folders`: in the order in which files are searched.
  explicit AssetFolders(std::vector<std::filesystem::path> folders) : folders_(std::move(folders)) {}

  /// True: `file` exists and lies in or below one of the folders, all links resolved.
  bool allow(const std::filesystem::path& file) const;
  const std::vector<std::filesystem::path>& all() const { return folders_; }

  /// File of the name that `node` holds, from the first folder that has the name. `what`: the kind of file, for error
  /// messages. Throws JsonError: an absolute name, no such file, a folder, no regular file, a file outside the folders.
  std::filesystem::path find(const JsonNode& node, std::string_view what) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace plumbline

// A scene's JSON, with what it includes.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/json/json_tree.h"

namespace plumbline {

/// A file and the files that its "include" lists, as one tree. A file is a patch of its includes (RFC 7396, JSON merge
/// patch): objects are merged key by key, null removes a key, everything else is replaced; of several includes a later
/// one patches the earlier ones. JsonValue::file of each value names the file in which the value stands.
/// Throws JsonError, also for cyclic includes, includes deeper than 8, and more than 64 files or 8 MiB in all.
class SceneJson {
 public:
  SceneJson(const std::filesystem::path& file, const AssetFolders& folders);
  SceneJson(const SceneJson&) = delete;
  SceneJson& operator=(const SceneJson&) = delete;
  JsonNode root() const { return {root_, ""}; }
  /// The file and the files that it includes, in the order in which they were read.
  std::vector<std::string> files() const { return {names_.begin(), names_.end()}; }

 private:
  JsonValue read(const std::filesystem::path& file, const AssetFolders& folders);

  std::deque<std::string> names_;             ///< a deque, as JsonValue::file points into it
  std::vector<std::filesystem::path> chain_;  ///< files being read, each included by the one before it
  std::size_t bytes_left_ = 8u << 20;         ///< JSON left to read; a tree takes some 100 times as much
  JsonValue root_;
};

}  // namespace plumbline

// A scene's JSON, with what it includes.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/json/asset_folders.h"
#include "scene/json/json_tree.h"

namespace plumbline {

/// A file and the files that its "include" lists, as one tree. What a file says is a patch of what it includes (RFC
/// 7396, JSON merge patch): objects are merged key by key, null takes a key away, everything else is replaced; of
/// several includes the later patch the earlier. Every value knows the file that it was written in.
/// Throws JsonError, also for includes that go round in a circle, deeper than 8, or for more than 64 files or 8 MiB in
/// all.
class SceneJson {
 public:
  SceneJson(const std::filesystem::path& file, const AssetFolders& folders);
  SceneJson(const SceneJson&) = delete;
  SceneJson& operator=(const SceneJson&) = delete;
  JsonNode root() const { return {root_, ""}; }
  /// The file, and those it includes, in the order in which they are read.
  std::vector<std::string> files() const { return {names_.begin(), names_.end()}; }

 private:
  JsonValue read(const std::filesystem::path& file, const AssetFolders& folders);

  std::deque<std::string> names_;             ///< a deque: the values point to them
  std::vector<std::filesystem::path> chain_;  ///< the files that are being read, each included by the one before
  std::size_t bytes_left_ = 8u << 20;         ///< a hundred times that in memory
  JsonValue root_;
};

}  // namespace plumbline

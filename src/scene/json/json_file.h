// JSON files as trees.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "scene/json/json_tree.h"

namespace plumbline {

/// Reads a file of JSON (comments allowed), of at most `most_bytes`. Every value points to `name`, which has to outlive
/// the tree and names the file in messages. Throws JsonError: no regular file, too long, not JSON, not UTF-8 or with a
/// byte order mark, NUL bytes, duplicate keys, numbers beyond double's range, nesting deeper than 64. Throws
/// std::filesystem::filesystem_error where the file's status cannot be read.
JsonValue read_json_file(const std::filesystem::path& path, const std::string& name, std::size_t most_bytes);

/// The tree of one JSON file of at most 16 MiB, with the name that its values point to. Throws as read_json_file().
class JsonFile {
 public:
  explicit JsonFile(const std::filesystem::path& path)
      : name_(path.string()), value_(read_json_file(path, name_, kMostBytes)) {}
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;
  JsonNode root() const { return {value_, ""}; }

 private:
  static constexpr std::size_t kMostBytes = 16u << 20;
  std::string name_;
  JsonValue value_;
};

}  // namespace plumbline

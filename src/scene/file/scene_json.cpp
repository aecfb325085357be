#include "scene/file/scene_json.h"

#include <algorithm>

#include <fmt/format.h>

#include "scene/json/json_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

/// JSON merge patch (RFC 7396, section 2). A merged object takes the file of the patch.
void patch(JsonValue& target, JsonValue&& with) {
  if (with.kind != JsonValue::Kind::object) {
    target = std::move(with);
    return;
  }
  if (target.kind != JsonValue::Kind::object) target = {.kind = JsonValue::Kind::object};
  target.file = with.file;
  for (auto& [key, value] : with.members) {
    if (value.kind == JsonValue::Kind::null)
      target.members.erase(key);
    else
      patch(target.members[key], std::move(value));
  }
}

}  // namespace

SceneJson::SceneJson(const fs::path& file, const AssetFolders& folders) : root_(read(file, folders)) {}

JsonValue SceneJson::read(const fs::path& file, const AssetFolders& folders) {
  constexpr std::size_t kDeepest = 8, kMostFiles = 64;
  names_.push_back(file.string());
  JsonValue own = read_json_file(file, names_.back(), bytes_left_);
  bytes_left_ -= std::min<std::uintmax_t>(bytes_left_, fs::file_size(file));
  if (own.kind != JsonValue::Kind::object) JsonNode(own, "").refuse("an object");
  if (!own.members.contains("include")) return own;

  chain_.push_back(fs::canonical(file));
  JsonValue whole{.kind = JsonValue::Kind::object, .file = own.file};
  for (const JsonNode& name : JsonNode(own, "")["include"].elements(1, kMostFiles)) {
    const fs::path included = folders.find(name, "a JSON file");
    if (std::find(chain_.begin(), chain_.end(), fs::canonical(included)) != chain_.end()) {
      name.refuse("files that do not include themselves", fmt::format("\"{}\" on the way to it", name.text()));
    }
    if (chain_.size() > kDeepest) name.refuse(fmt::format("at most {} levels of includes", kDeepest), "more");
    if (names_.size() == kMostFiles) name.refuse(fmt::format("at most {} files in all", kMostFiles), "more");
    patch(whole, read(included, folders));
  }
  chain_.pop_back();
  own.members.erase("include");
  patch(whole, std::move(own));
  return whole;
}

}  // namespace plumbline

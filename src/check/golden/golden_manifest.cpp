#include "check/golden/golden_manifest.h"

#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "scene/json/json_file.h"

namespace plumbline::check {

namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr std::string_view kFormat = "plumbline goldens";
constexpr std::array<std::string_view, 3> kKinds = {"color", "depth", "stages"};
constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;

// Everything but the seal.
Json json_of(const Golden& golden) {
  Json files = Json::object();
  for (const auto& [kind, f] : golden.files) {
    files[kind] = {{"file", f.file}, {"format", f.format}, {"bytes", f.bytes}, {"hash", to_string(f.hash)}};
  }
  return {{"scene", to_string(golden.scene)}, {"producer", golden.producer},
          {"versions", golden.versions},      {"files", files},
          {"references", golden.references},  {"vouched", golden.vouched},
          {"disputed", golden.disputed}};
}

Hash seal_of(const std::string& name, const Golden& golden) {
  return hash_of(fmt::format("{}: {}", name, json_of(golden).dump()));
}

Hash read_hash(const JsonNode& node) {
  const std::optional<Hash> hash = parse_hash(node.text());
  if (!hash) node.refuse("a hash of 32 hexadecimal digits");
  return *hash;
}

// Whether the name is a path inside the folder of goldens.
bool may_have_golden(const std::string& name) {
  const fs::path path = name;
  return !name.empty() && path.is_relative() && path.lexically_normal().string() == name && *path.begin() != ".." &&
         path.has_filename() && path != ".";
}

std::map<std::string, std::string> read_texts(const JsonNode& node) {
  if (node.value().kind != JsonValue::Kind::object) node.refuse("an object");
  std::map<std::string, std::string> out;
  for (const auto& [key, value] : node.value().members) out[key] = node[key].text();
  return out;
}

std::vector<std::string> read_list(const JsonNode& node) {
  std::vector<std::string> out;
  for (const JsonNode& n : node.elements(0, 1000)) out.push_back(n.text());
  return out;
}

Golden read_golden(const JsonNode& node, const std::string& name) {
  if (!may_have_golden(name)) node.refuse("a scene's name, group/file");
  node.only({"scene", "producer", "versions", "files", "references", "vouched", "disputed", "seal"});
  Golden out;
  out.scene = read_hash(node["scene"]);
  out.producer = node["producer"].text();
  out.versions = node["versions"].text();
  const JsonNode files = node["files"];
  files.only(kKinds);
  for (const std::string_view kind : kKinds) {
    const JsonNode n = files[kind];
    n.only({"file", "format", "bytes", "hash"});
    GoldenFile file{n["file"].text(), n["format"].text(), static_cast<std::uint64_t>(n["bytes"].integer(0, kMostBytes)),
                    read_hash(n["hash"])};
    const std::string named = golden_file_name(name, std::string(kind), file.hash, file.format);
    if (file.file != named) n["file"].refuse(named + ", after its scene and hash");
    out.files.emplace(kind, std::move(file));
  }
  const JsonNode references = node["references"];
  if (references.value().kind != JsonValue::Kind::object) references.refuse("an object");
  for (const auto& [key, value] : references.value().members) out.references[key] = read_texts(references[key]);
  out.vouched = read_list(node["vouched"]);
  out.disputed = read_list(node["disputed"]);
  if (read_hash(node["seal"]) != seal_of(name, out)) {
    node["seal"].refuse("the seal of what stands here, which plumb golden update writes: a hand has changed it",
                        "another");
  }
  return out;
}

std::string dumped(const Json& json, const std::string& name) {
  try {
    return json.dump();
  } catch (const Json::exception&) {
    throw GoldenError(fmt::format("{}: expected names and words in UTF-8", name));
  }
}

}  // namespace

std::string golden_file_name(const std::string& scene, const std::string& kind, const Hash& hash,
                             const std::string& format) {
  const char* ending = kind == "stages" ? "json" : kind == "color" && format != "rgba32f" ? "png" : "exr";
  return fmt::format("{}/{}.{:.16}.{}", scene, kind, to_string(hash), ending);
}

std::string key_of(const std::map<std::string, std::string>& versions) {
  return to_string(hash_of(Json(versions).dump())).substr(0, 8);
}

GoldenManifest read_golden_manifest(const fs::path& file) {
  try {
    const JsonFile json(file);
    const JsonNode root = json.root();
    root.only({"format", "version", "versions", "scenes"});
    if (root["format"].text() != kFormat) root["format"].refuse(fmt::format("\"{}\"", kFormat));
    root["version"].integer(1, 1);
    GoldenManifest out;
    const JsonNode versions = root["versions"], scenes = root["scenes"];
    if (versions.value().kind != JsonValue::Kind::object) versions.refuse("an object");
    if (scenes.value().kind != JsonValue::Kind::object) scenes.refuse("an object");
    for (const auto& [key, value] : versions.value().members) {
      out.versions[key] = read_texts(versions[key]);
      if (key_of(out.versions[key]) != key) versions[key].refuse("the versions that have this hash", "others");
    }
    for (const auto& [name, value] : scenes.value().members) {
      Golden golden = read_golden(scenes[name], name);
      if (!out.versions.contains(golden.versions)) scenes[name]["versions"].refuse("a key of /versions");
      out.scenes.emplace(name, std::move(golden));
    }
    return out;
  } catch (const JsonError& error) {
    throw GoldenError(error.what());
  }
}

std::string manifest_text(const GoldenManifest& manifest) {
  std::set<std::string> named;
  for (const auto& [name, golden] : manifest.scenes) named.insert(golden.versions);
  std::vector<std::string> versions, scenes;
  const auto line = [](const std::string& key, const Json& value) {
    return fmt::format("{}: {}", dumped(key, key), dumped(value, key));
  };
  for (const std::string& key : named) versions.push_back(line(key, manifest.versions.at(key)));
  for (const auto& [name, golden] : manifest.scenes) {
    if (!may_have_golden(name)) throw GoldenError(fmt::format("{}: expected a scene's name, group/file", name));
    Json json = json_of(golden);
    dumped(json, name);
    json["seal"] = to_string(seal_of(name, golden));
    scenes.push_back(line(name, json));
  }
  return fmt::format("{{\"format\": \"{}\", \"version\": 1,\n\"versions\": {{\n{}\n}},\n\"scenes\": {{\n{}\n}}}}\n",
                     kFormat, fmt::join(versions, ",\n"), fmt::join(scenes, ",\n"));
}

std::string stages_text(const StageHashes& stages) {
  Json out = Json::object();
  for (std::size_t i = 0; i < stages.size(); ++i) {
    if (stages[i]) out[std::string(kStageNames[i])] = to_string(*stages[i]);
  }
  return out.dump(1) + "\n";
}

StageHashes read_stages(const fs::path& file) {
  try {
    const JsonFile json(file);
    const JsonNode root = json.root();
    root.only(kStageNames);
    StageHashes out;
    for (std::size_t i = 0; i < out.size(); ++i) {
      if (const auto node = root.find(kStageNames[i])) out[i] = read_hash(*node);
    }
    return out;
  } catch (const JsonError& error) {
    throw GoldenError(error.what());
  }
}

}  // namespace plumbline::check

// The scene format is written once, in the schema: the parser has its keys, required keys, values and defaults, and
// README.md of src/scene names them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/file/scene_file.h"
#include "scene/json/json_file.h"
#include "tests/property/scene_text.h"
#include "tests/scene/schema_samples.h"
#include "tests/suite.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

using namespace test;

class SceneSchema : public TestFolder {
 protected:
  SceneSchema() : file_(suite_folder() / "scene.schema.json"), schema_(file_.root()) {
    test::write_text(root_ / "empty.part.json", "{}");
    // One texel: uncompressed, 1 x 1, 24 bits
    test::write_text(root_ / "image.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\30\0\1\2\3", 21));
    test::write_text(root_ / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  }

  /// A definition by its path below "definitions"; empty: the scene.
  JsonNode definition(std::string path) const {
    JsonNode node = schema_;
    if (!path.empty()) node = node["definitions"];
    while (!path.empty()) {
      const std::size_t end = std::min(path.find('/'), path.size());
      node = node[path.substr(0, end)];
      path.erase(0, end + 1);
    }
    return node;
  }
  /// The schema that "$ref" or "allOf" name, if they are there.
  std::optional<JsonNode> referred(JsonNode node) const {
    if (const auto all = node.find("allOf")) node = (*all)[0u];
    const auto ref = node.find("$ref");
    if (!ref) return std::nullopt;
    return definition(ref->text().substr(std::string("#/definitions/").size()));
  }
  JsonNode resolved(JsonNode node) const {
    const auto other = referred(node);
    return other ? resolved(*other) : node;
  }
  std::optional<JsonNode> default_of(JsonNode node) const {
    if (const auto value = node.find("default")) return value;
    const auto other = referred(node);
    return other ? default_of(*other) : std::nullopt;
  }
  Scene load(const Sample& sample, const Members& members) const {
    std::string text = sample.scene;
    text.replace(text.find('$'), 1, object(members));
    test::write_text(root_ / "scene.json", text);
    return load_scene(root_ / "scene.json", {.asset_folders = {}});
  }
  /// The loader's error, without file and place; "" if it reads the scene.
  std::string said_of(const Sample& sample, const Members& members) const {
    try {
      load(sample, members);
    } catch (const SceneError& error) {
      const std::string what = error.what();
      return what.substr(what.find(": expected ") + 2);
    }
    return "";
  }
  static bool alternatives(const JsonNode& definition) { return definition.find("maxProperties").has_value(); }
  static std::set<std::string> keys_of(const JsonNode& node) {
    std::set<std::string> keys;
    for (const auto& [key, value] : node.value().members) keys.insert(key);
    return keys;
  }

  JsonFile file_;
  JsonNode schema_;
};

/// How the loader tells what it expects, from a property's schema.
std::string expectation(const JsonNode& schema) {
  const auto limit = [&](const char* key) { return schema[key].value().real; };
  if (const auto values = schema.find("enum")) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < values->size(); ++i) names.push_back((*values)[i].text());
    return fmt::format("one of {}", fmt::join(names, ", "));
  }
  const std::string type = schema["type"].text();
  if (type == "boolean") return "true or false";
  if (type == "string") return "a string that is not empty";
  if (type == "number") return fmt::format("a number from {} to {}", limit("minimum"), limit("maximum"));
  if (type == "integer") {
    if (limit("minimum") == limit("maximum")) return fmt::format("{}", limit("minimum"));
    return fmt::format("an integer from {} to {}", schema["minimum"].value().integer,
                       schema["maximum"].value().integer);
  }
  if (type == "object") {  // with keys of its own, or any
    const auto others = schema.find("additionalProperties");
    return others && others->value().kind == JsonValue::Kind::object ? "an object" : "an object with keys among";
  }
  const auto least = limit("minItems");
  const auto most = schema.find("maxItems");
  if (!most) return fmt::format("an array of {} or more", least);
  if (most->value().real == least) return fmt::format("an array of {}", least);
  return fmt::format("an array of {} to {}", least, most->value().real);
}

TEST_F(SceneSchema, HasTheLoadersKeys) {
  for (const Sample& sample : kSchemaSamples) {
    const JsonNode schema = definition(sample.definition);
    const std::string said = said_of(sample, with({}, "?", "0"));
    const std::string head = "expected a key among ";
    ASSERT_EQ(said.substr(0, head.size()), head) << sample.definition;
    std::set<std::string> keys;
    std::string list = said.substr(head.size(), said.find(", found the unknown key") - head.size()) + ", ";
    for (std::size_t at = 0; (at = list.find(", ")) != list.npos; list.erase(0, at + 2)) {
      if (list.substr(0, at) != "none") keys.insert(list.substr(0, at));
    }
    EXPECT_EQ(keys, keys_of(schema["properties"])) << sample.definition;
    EXPECT_FALSE(schema["additionalProperties"].boolean()) << sample.definition;
  }
}

TEST_F(SceneSchema, EveryObjectOfItIsHere) {
  std::set<std::string> objects, here;
  for (const auto& [name, value] : schema_["definitions"].value().members) {
    if (value.members.contains("properties")) objects.insert(name);
  }
  for (const Sample& sample : kSchemaSamples) here.insert(sample.definition);
  here.erase("");
  EXPECT_EQ(here, objects);
}

TEST_F(SceneSchema, ItsKeysAreReadAndNeededAsItSays) {
  for (const Sample& sample : kSchemaSamples) {
    const JsonNode schema = definition(sample.definition);
    std::set<std::string> keys;
    for (const auto& [key, value] : sample.members) keys.insert(key);
    if (sample.definition == "light") keys.insert("directional");  // instead of point
    EXPECT_EQ(keys, keys_of(schema["properties"])) << sample.definition;
    if (alternatives(schema)) {
      for (const auto& [key, value] : sample.members) EXPECT_EQ(said_of(sample, {{key, value}}), "") << key;
      continue;
    }
    EXPECT_EQ(said_of(sample, sample.members), "") << sample.definition;
    std::set<std::string> required;
    if (const auto list = schema.find("required")) {
      for (std::size_t i = 0; i < list->size(); ++i) required.insert((*list)[i].text());
    }
    if (sample.definition.empty()) required = {"description", "draws"};  // if nothing is included
    if (sample.definition == "light") required = {"point"};
    for (const auto& [key, value] : sample.members) {
      Members less = sample.members;
      less.erase(key);
      EXPECT_EQ(said_of(sample, less).empty(), !required.contains(key)) << sample.definition << " " << key;
    }
  }
}

/// The first values beyond the limits of a number.
std::vector<std::string> beyond(const JsonNode& schema) {
  const auto type = schema.find("type");
  std::vector<std::string> out;
  for (const auto& [limit, sign] : {std::pair("minimum", -1), std::pair("maximum", 1)}) {
    if (!type || !schema.find(limit)) continue;
    const JsonValue value = schema[limit].value();
    if (type->text() == "number") {
      out.push_back(fmt::format("{}", value.real + sign * std::max(1e-9, 1e-9 * std::abs(value.real))));
    } else if (std::abs(value.real) < 1e15) {
      out.push_back(fmt::format("{}", value.integer + sign));
    }
  }
  return out;
}

TEST_F(SceneSchema, ItsValuesAreTheLoaders) {
  for (const Sample& sample : kSchemaSamples) {
    const JsonNode schema = definition(sample.definition);
    for (const auto& [key, value] : sample.members) {
      const bool corners =
          key == "indices" || key == "colors" || key == "texcoords" ||
          (key == "normals" && sample.definition == "triangles");  // as many as positions; of these, each
      if (corners) continue;
      // false, as null takes a key away from what is included; where false is right, 0
      const JsonNode property = resolved(schema["properties"][key]);
      const bool boolean = property.find("type") && property["type"].text() == "boolean";
      const Members bad =
          alternatives(schema) ? Members{{key, "false"}} : with(sample.members, key, boolean ? "0" : "false");
      const std::string expected = "expected " + expectation(property);
      for (const std::string& value_beyond : beyond(property)) {
        const Members members =
            alternatives(schema) ? Members{{key, value_beyond}} : with(sample.members, key, value_beyond);
        EXPECT_TRUE(said_of(sample, members).starts_with(expected)) << sample.definition << " " << key << value_beyond;
      }
      std::string said = said_of(sample, bad);
      EXPECT_EQ(said.substr(0, expected.size()), expected) << sample.definition << " " << key;
      said.erase(0, expected.size());
      EXPECT_TRUE(said.starts_with(", found ") || expected.ends_with("among"))
          << sample.definition << " " << key << said;
    }
  }
}

/// A JSON value as text.
std::string text_of(const JsonValue& value) {
  switch (value.kind) {
    case JsonValue::Kind::null: return "null";
    case JsonValue::Kind::boolean: return value.boolean ? "true" : "false";
    case JsonValue::Kind::integer: return fmt::format("{}", value.integer);
    case JsonValue::Kind::real: return fmt::format("{}", value.real);
    case JsonValue::Kind::text: return "\"" + value.text + "\"";
    case JsonValue::Kind::array: break;
    case JsonValue::Kind::object: ADD_FAILURE() << "no default is an object";
  }
  std::vector<std::string> items;
  for (const JsonValue& item : value.items) items.push_back(text_of(item));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

/// Everything that a scene file can say of a scene, as text.
std::string content_of(const Scene& scene) {
  std::string text = test::scene_text(scene, "");
  text += fmt::format("{} {}\n", static_cast<int>(scene.frame.antialias.kind), scene.frame.antialias.factor);
  for (const Texture& t : scene.textures) {
    const Sampler& s = t.sampler;
    text += fmt::format("{} {} {} {} {} {} {} {} {} {} {}\n", static_cast<int>(t.format), static_cast<int>(t.type),
                        static_cast<int>(s.min), static_cast<int>(s.mag), static_cast<int>(s.wrap_s),
                        static_cast<int>(s.wrap_t), s.lod_bias, s.min_lod, s.max_lod, s.base_level, s.max_level);
    text += test::text::vector(s.border);
    for (const glm::vec4& texel : t.levels.at(0).texels) text += test::text::vector(texel);
  }
  for (const Draw& d : scene.draws) {
    if (!d.texture) continue;
    text += fmt::format("{} {} ", d.texture->texture, static_cast<int>(d.texture->environment));
    text += test::text::vector(d.texture->color);
  }
  return text;
}

TEST_F(SceneSchema, ItsDefaultsAreTheLoaders) {
  int defaults = 0, others_count = 0;
  for (const Sample& sample : kSchemaSamples) {
    const JsonNode schema = definition(sample.definition);
    for (const auto& [key, value] : sample.members) {
      const auto as_said = default_of(schema["properties"][key]);
      if (!as_said) continue;
      ++defaults;
      Members others = alternatives(schema) ? Members{} : sample.members;
      others.erase(key);
      const std::string left_out = content_of(load(sample, others));
      EXPECT_TRUE(content_of(load(sample, with(others, key, text_of(as_said->value())))) == left_out)
          << sample.definition << " " << key;
      if (content_of(load(sample, sample.members)) != left_out) ++others_count;
    }
  }
  EXPECT_GE(defaults, 90);
  EXPECT_GE(others_count, 50) << "samples that are not the default: their keys count";
}

// The table of the format: a row for each part, its keys in backquotes.
TEST_F(SceneSchema, ItsKeysAreTheReadmes) {
  std::ifstream readme(PLUMBLINE_SOURCE_DIR "/src/scene/README.md");
  std::set<std::string> listed;
  bool in_format = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("## ")) in_format = line == "## The format";
    if (!in_format || !line.starts_with("| ")) continue;
    for (std::size_t at = line.find('`'); at != line.npos; at = line.find('`', at + 1)) {
      const std::size_t end = line.find('`', at + 1);
      listed.insert(line.substr(at + 1, end - at - 1));
      at = end;
    }
  }
  std::set<std::string> keys = keys_of(schema_["properties"]);
  for (const char* part : {"frame", "draw"}) keys.merge(keys_of(definition(part)["properties"]));
  EXPECT_EQ(listed, keys);
}

}  // namespace
}  // namespace plumbline

// Hard scenes: each is a scene file that is read, and together they reach every state of the scene format.
#include <set>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "campaign/scene_id.h"
#include "scene/file/scene_file.h"
#include "tests/suite.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::campaign {
namespace {

using Json = nlohmann::json;

/// States of the format by name: KIND.KEY, and KIND.KEY=VALUE of words and truth values.
class States {
 public:
  States() { schema_ = Json::parse(test::text_of(suite_folder() / "scene.schema.json")); }

  /// All states.
  std::set<std::string> all() const {
    std::set<std::string> out;
    add_all("scene", schema_, out);
    for (const char* kind : {"projection", "gzrender_projection", "games101_projection", "tinyrenderer_projection"}) {
      add_all(kind, schema_["definitions"][kind], out);
    }
    return out;
  }

  /// States of a scene.
  std::set<std::string> of(const Json& scene) const {
    std::set<std::string> out;
    add("scene", schema_, scene, out);
    const std::string dialect = scene.value("dialect", "gl");
    const std::string kind = dialect == "gl" ? "projection" : dialect + "_projection";
    add(kind, schema_["definitions"][kind], scene["projection"], out);
    return out;
  }

 private:
  /// A schema without what it refers to, and the name of what it is.
  struct Named {
    std::string name;
    const Json* schema;
  };
  Named resolved(std::string name, const Json& schema) const {
    if (schema.contains("allOf") && schema["allOf"][0].contains("$ref")) return resolved(name, schema["allOf"][0]);
    if (!schema.contains("$ref")) return {name, &schema};
    const std::string ref = schema["$ref"].get<std::string>().substr(1);  // without the #
    const std::string last = ref.substr(ref.rfind('/') + 1);
    const Json& of = schema_.at(Json::json_pointer(ref));
    return resolved(of.contains("properties") ? last : name, of);
  }

  void add_all(const std::string& given, const Json& unresolved, std::set<std::string>& out) const {
    const auto [name, schema] = resolved(given, unresolved);
    if (schema->contains("enum")) {
      for (const Json& value : (*schema)["enum"]) out.insert(name + "=" + value.get<std::string>());
    }
    if (schema->value("type", Json()) == "boolean") out.insert({name + "=true", name + "=false"});
    if (schema->contains("items")) add_all(name, (*schema)["items"], out);
    if (schema->contains("additionalProperties") && (*schema)["additionalProperties"].is_object()) {
      add_all(name, (*schema)["additionalProperties"], out);
    }
    if (!schema->contains("properties")) return;
    for (const auto& [key, of] : (*schema)["properties"].items()) {
      if (out.insert(name + "." + key).second) add_all(name + "." + key, of, out);
    }
  }

  void add(const std::string& given, const Json& unresolved, const Json& value, std::set<std::string>& out) const {
    const auto [name, schema] = resolved(given, unresolved);
    if (schema->contains("enum")) out.insert(name + "=" + value.get<std::string>());
    if (value.is_boolean()) out.insert(name + (value.get<bool>() ? "=true" : "=false"));
    if (value.is_array() && schema->contains("items")) {
      for (const Json& item : value) add(name, (*schema)["items"], item, out);
    }
    if (!value.is_object()) return;
    for (const auto& [key, of] : value.items()) {
      if (!schema->contains("properties")) {
        if (schema->contains("additionalProperties")) add(name, (*schema)["additionalProperties"], of, out);
        continue;
      }
      out.insert(name + "." + key);
      add(name + "." + key, (*schema)["properties"].at(key), of, out);
    }
  }

  Json schema_;
};

std::string text_of(std::uint64_t seed) { return scene_text({Generator::hard, {seed}}); }

TEST(HardScenes, ReachEveryStateOfTheSceneFormat) {
  const States states;
  std::set<std::string> missing = states.all();
  EXPECT_GT(missing.size(), 250u);
  // Keys of files, not of scenes; keys of defaults are the draws'.
  std::erase_if(missing, [](const std::string& state) {
    for (const char* beside : {"scene.$schema", "scene.include", "mesh.file", "image.file", "defaults."}) {
      if (state.starts_with(beside)) return true;
    }
    return false;
  });
  for (std::uint64_t seed = 1; seed <= 2000 && !missing.empty(); ++seed) {
    for (const std::string& state : states.of(Json::parse(text_of(seed)))) missing.erase(state);
  }
  EXPECT_TRUE(missing.empty()) << fmt::format("{}", fmt::join(missing, "\n"));
}

class HardSceneFiles : public TestFolder {};

TEST_F(HardSceneFiles, AreRead) {
  for (std::uint64_t seed = 1; seed <= 4000; seed += 7) {
    test::write_text(root_ / "scene.json", text_of(seed));
    EXPECT_NO_THROW(load_scene(root_ / "scene.json")) << text_of(seed);
  }
}

}  // namespace
}  // namespace plumbline::campaign

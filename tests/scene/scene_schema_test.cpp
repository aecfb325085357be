// The schema that editors use says what the loader does: the same keys, the same ones needed, the same values.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/file/scene_file.h"
#include "scene/json/json_file.h"
#include "tests/test_folder.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

using Members = std::map<std::string, std::string>;  // key and value, as JSON

std::string object(const Members& members) {
  std::string text;
  for (const auto& [key, value] : members) text += (text.empty() ? "\"" : ", \"") + key + "\": " + value;
  return "{" + text + "}";
}

/// One of the schema's objects: good values for all of its keys (of alternatives, each good alone), and where in a
/// scene it stands, as the "$" of `scene`.
struct Sample {
  std::string definition;  ///< empty: the scene
  std::string scene;
  Members members;
};

const std::string kTexture = R"("textures": {"t": {"image": {"noise": {}}}}, )";
const std::string kTop = R"({"description": "d", "draws": [{"mesh": {"cube": {}}}])";
const std::string kInTop = kTop + ", ";
const std::string kInDraw = R"({"description": "d", )" + kTexture + R"("draws": [{"mesh": {"cube": {}}, )";
std::string in_mesh(const std::string& kind) {
  return R"({"description": "d", "draws": [{"mesh": {")" + kind + R"(": $}}]})";
}
std::string in_textures(const std::string& texture) { return kTop + R"(, "textures": {"t": )" + texture + "}}"; }
std::string in_image(const std::string& kind) { return in_textures(R"({"image": {")" + kind + R"(": $}})"); }
const Members kCells = {{"width", "4"}, {"height", "3"}, {"columns", "2"}, {"rows", "3"}};
const Members kSides = {{"left", "-1"}, {"right", "1"}, {"bottom", "-1"}, {"top", "1"}, {"near", "1"}, {"far", "2"}};
const Members kCoordinates = {{"left", "-1"}, {"right", "1"}, {"bottom", "-1"},
                              {"top", "1"},   {"near", "1"},  {"far", "-2"}};
const Members kState = {{"transforms", "[]"},
                        {"material", "{}"},
                        {"back_material", "{}"},
                        {"lit", "true"},
                        {"color_material", "\"diffuse\""},
                        {"normals", "\"rescale\""},
                        {"shading", "\"flat\""},
                        {"cull", "\"none\""},
                        {"front_mode", "\"fill\""},
                        {"back_mode", "\"fill\""},
                        {"line_width", "16"},
                        {"point_size", "64"},
                        {"depth_func", "\"less\""},
                        {"depth_range", "[1, 0]"},
                        {"polygon_offset", "{}"},
                        {"alpha_test", R"({"func": "less"})"},
                        {"stencil", "{}"},
                        {"fog", R"({"exp": {"density": 1}})"},
                        {"scissor", "[0, 0, 1, 1]"},
                        {"depth_mask", "true"},
                        {"blend", "{}"},
                        {"logic_op", "\"xor\""},
                        {"color_mask", "[true, true, true, false]"},
                        {"texture", R"({"name": "t"})"}};
const Members kTerm = {{"source", "\"source_alpha_saturate\""}, {"destination", "\"zero\""}, {"equation", "\"min\""}};
const Members kStencil = {{"func", "\"less\""},       {"reference", "1"},     {"mask", "255"},    {"fail", "\"keep\""},
                          {"depth_fail", "\"zero\""}, {"pass", "\"invert\""}, {"write_mask", "7"}};
const std::string kThree = "[[0, 0, 0], [1, 0, 0], [0, 1, 0]]", kWhite = "[1, 1, 1, 1]";

Members with(Members members, const std::string& key, const std::string& value) {
  members[key] = value;
  return members;
}

const std::vector<Sample> kSamples = {
    {"",
     "$",
     {{"$schema", "\"s\""},
      {"include", "[\"empty.part.json\"]"},
      {"description", "\"d\""},
      {"dialect", "\"gl\""},
      {"frame", "{}"},
      {"camera", "{}"},
      {"projection", R"({"perspective": {"fov_y": 9, "near": 1, "far": 2}})"},
      {"ambient", "[0, 0, 0]"},
      {"light_model", "{}"},
      {"lights", "[]"},
      {"textures", "{}"},
      {"defaults", "{}"},
      {"draws", R"([{"mesh": {"cube": {}}}])"}}},
    {"frame",
     kInTop + R"("frame": $})",
     {{"width", "3"},
      {"height", "3"},
      {"color", "\"rgba8\""},
      {"depth", "\"z16\""},
      {"clear_color", kWhite},
      {"clear_depth", "1"},
      {"stencil", "\"s8\""},
      {"clear_stencil", "255"},
      {"antialias", R"({"samples": 4})"}}},
    {"polygon_offset", kInDraw + R"("polygon_offset": $}]})", {{"factor", "1"}, {"units", "-2"}}},
    {"alpha_test", kInDraw + R"("alpha_test": $}]})", {{"func", "\"less\""}, {"reference", "0.5"}}},
    {"stencil", kInDraw + R"("stencil": $}], "frame": {"stencil": "s8"}})", with(kStencil, "back", "{}")},
    {"stencil_back", kInDraw + R"("stencil": {"back": $}}], "frame": {"stencil": "s8"}})", kStencil},
    {"antialias",
     kInTop + R"("frame": {"antialias": $}})",
     {{"samples", "4"}, {"supersample", "8"}, {"taps", "\"gzrender\""}}},
    {"camera", kInTop + R"("camera": $})", {{"eye", "[1, 2, 3]"}, {"center", "[0, 0, 0]"}, {"up", "[0, 1, 0]"}}},
    {"projection",
     kInTop + R"("projection": $})",
     {{"perspective", R"({"fov_y": 9, "near": 1, "far": 2})"},
      {"orthographic", object(kSides)},
      {"frustum", object(kSides)}}},
    {"perspective", kInTop + R"("projection": {"perspective": $}})", {{"fov_y", "9"}, {"near", "1"}, {"far", "2"}}},
    {"orthographic", kInTop + R"("projection": {"orthographic": $}})", kSides},
    {"frustum", kInTop + R"("projection": {"frustum": $}})", kSides},
    {"games101_projection",
     kInTop + R"("dialect": "games101", "projection": $})",
     {{"perspective", R"({"fov_y": 9, "near": -1, "far": -2})"}, {"orthographic", object(kCoordinates)}}},
    {"games101_perspective",
     kInTop + R"("dialect": "games101", "projection": {"perspective": $}})",
     {{"fov_y", "9"}, {"near", "-1"}, {"far", "-2"}}},
    {"games101_orthographic", kInTop + R"("dialect": "games101", "projection": {"orthographic": $}})", kCoordinates},
    {"gzrender_projection", kInTop + R"("dialect": "gzrender", "projection": $})", {{"x_pi", R"({"fov": 9})"}}},
    {"x_pi", kInTop + R"("dialect": "gzrender", "projection": {"x_pi": $}})", {{"fov", "9"}}},
    {"tinyrenderer_projection", kInTop + R"("dialect": "tinyrenderer", "projection": $})", {{"pinhole", "{}"}}},
    {"pinhole", kInTop + R"("dialect": "tinyrenderer", "projection": {"pinhole": $}})", {{"c", "2"}}},
    {"light",
     kInTop + R"("lights": [$]})",
     {{"point", "[0, 0, 0]"},
      {"ambient", "[0, 0, 0]"},
      {"diffuse", "[0, 0, 0]"},
      {"specular", "[0, 0, 0]"},
      {"attenuation", "[1, 0, 0]"},
      {"spot", R"({"direction": [0, 0, 1], "cutoff": 9})"}}},
    {"spot",
     kInTop + R"("lights": [{"point": [0, 0, 0], "spot": $}]})",
     {{"direction", "[0, 0, 1]"}, {"cutoff", "9"}, {"exponent", "2"}}},
    {"light_model",
     kInTop + R"("light_model": $})",
     {{"local_viewer", "true"}, {"specular", "\"reflection\""}, {"sides", "\"flip\""}, {"separate_specular", "true"}}},
    {"material",
     kInDraw + R"("material": $}]})",
     {{"ambient", kWhite}, {"diffuse", kWhite}, {"specular", kWhite}, {"emission", kWhite}, {"shininess", "3"}}},
    {"texture",
     in_textures("$"),
     {{"image", R"({"noise": {}})"},
      {"format", "\"rgb\""},
      {"texels", "\"float32\""},
      {"min", "\"linear\""},
      {"mag", "\"nearest\""},
      {"wrap_s", "\"repeat\""},
      {"wrap_t", "\"clamp_to_edge\""},
      {"border", kWhite},
      {"lod_bias", "1"},
      {"min_lod", "-1"},
      {"max_lod", "2"},
      {"base_level", "1"},
      {"max_level", "3"}}},
    {"image",
     in_textures(R"({"image": $})"),
     {{"file", "\"image.tga\""},
      {"texels", "[[" + kWhite + "]]"},
      {"checker", "{}"},
      {"gradient", "{}"},
      {"bricks", "{}"},
      {"uv_grid", "{}"},
      {"noise", "{}"}}},
    {"checker", in_image("checker"), with(kCells, "colors", "[" + kWhite + ", " + kWhite + "]")},
    {"bricks", in_image("bricks"), with(kCells, "colors", "[" + kWhite + ", " + kWhite + "]")},
    {"gradient",
     in_image("gradient"),
     {{"width", "3"}, {"height", "2"}, {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + ", " + kWhite + "]"}}},
    {"uv_grid", in_image("uv_grid"), kCells},
    {"noise", in_image("noise"), {{"width", "3"}, {"height", "2"}, {"seed", "7"}}},
    {"draw_texture",
     kInDraw + R"("texture": $}]})",
     {{"name", "\"t\""}, {"environment", "\"blend\""}, {"color", kWhite}}},
    {"fog",
     kInDraw + R"("fog": $}]})",
     {{"exp", R"({"density": 1})"}, {"exp2", R"({"density": 1})"}, {"linear", R"({"start": 1, "end": 2})"}}},
    {"linear_fog", kInDraw + R"("fog": {"linear": $}}]})", {{"color", "[1, 1, 1]"}, {"start", "1"}, {"end", "2"}}},
    {"exponential_fog", kInDraw + R"("fog": {"exp": $}}]})", {{"color", "[1, 1, 1]"}, {"density", "1"}}},
    {"blend", kInDraw + R"("blend": $}]})", with(with(kTerm, "alpha", "{}"), "color", kWhite)},
    {"blend_alpha", kInDraw + R"("blend": {"alpha": $}}]})", kTerm},
    {"transform",
     kInDraw + R"("transforms": [$]}]})",
     {{"translate", "[0, 0, 0]"}, {"rotate", R"({"degrees": 1, "axis": [0, 0, 1]})"}, {"scale", "[1, 1, 1]"}}},
    {"rotate", kInDraw + R"("transforms": [{"rotate": $}]}]})", {{"degrees", "1"}, {"axis", "[0, 0, 1]"}}},
    {"defaults", kInTop + kTexture + R"("frame": {"stencil": "s8"}, "defaults": $})", kState},
    {"draw", R"({"description": "d", "frame": {"stencil": "s8"}, )" + kTexture + R"("draws": [$]})",
     with(kState, "mesh", R"({"cube": {}})")},
    {"mesh",
     R"({"description": "d", "draws": [{"mesh": $}]})",
     {{"file", "\"mesh.obj\""},
      {"triangle", "{\"positions\": " + kThree + "}"},
      {"triangles", "{\"positions\": " + kThree + ", \"indices\": [[0, 1, 2]]}"},
      {"lines", R"({"positions": [[0, 0, 0], [1, 0, 0]], "indices": [[0, 1]]})"},
      {"points", R"({"positions": [[0, 0, 0]]})"},
      {"quad", "{}"},
      {"grid", R"({"columns": 1, "rows": 1})"},
      {"cube", "{}"},
      {"uv_sphere", R"({"slices": 3, "stacks": 2})"},
      {"globe", R"({"slices": 3, "stacks": 2})"},
      {"icosphere", R"({"subdivisions": 0})"},
      {"torus_knot", R"({"segments": 9, "sides": 3})"},
      {"revolution", R"({"profile": [[1, 0], [1, 1], [1, 2], [1, 3]], "steps": 1, "slices": 3})"},
      {"soup", R"({"triangles": 1, "seed": 0, "extent": 1, "size": 1})"}}},
    {"triangle",
     in_mesh("triangle"),
     {{"positions", kThree},
      {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + "]"},
      {"texcoords", "[[0, 0], [1, 0], [0, 1]]"}}},
    {"triangles",
     in_mesh("triangles"),
     {{"positions", kThree},
      {"indices", "[[0, 1, 2]]"},
      {"normals", "[[0, 0, 1], [0, 1, 0], [0.707, 0, -0.707]]"},
      {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + "]"},
      {"texcoords", "[[0, 0], [1, 0], [0, 1]]"}}},
    {"lines",
     in_mesh("lines"),
     {{"positions", "[[0, 0, 0], [1, 0, 0]]"},
      {"indices", "[[1, 0]]"},
      {"colors", "[" + kWhite + ", " + kWhite + "]"}}},
    {"points", in_mesh("points"), {{"positions", "[[0, 0, 0]]"}, {"colors", "[" + kWhite + "]"}}},
    {"quad",
     in_mesh("quad"),
     {{"positions", "[[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]"},
      {"colors", "[" + kWhite + ", " + kWhite + ", " + kWhite + ", " + kWhite + "]"},
      {"texcoords", "[[0, 0], [1, 0], [1, 1], [0, 1]]"}}},
    {"grid", in_mesh("grid"), {{"columns", "1"}, {"rows", "1"}}},
    {"cube", in_mesh("cube"), {}},
    {"uv_sphere", in_mesh("uv_sphere"), {{"slices", "3"}, {"stacks", "2"}}},
    {"globe", in_mesh("globe"), {{"slices", "3"}, {"stacks", "2"}}},
    {"icosphere", in_mesh("icosphere"), {{"subdivisions", "0"}}},
    {"torus_knot", in_mesh("torus_knot"), {{"p", "2"}, {"q", "3"}, {"tube", "0.1"}, {"segments", "9"}, {"sides", "3"}}},
    {"revolution",
     in_mesh("revolution"),
     {{"profile", "[[1, 0], [1, 1], [1, 2], [1, 3]]"}, {"steps", "1"}, {"slices", "3"}}},
    {"soup", in_mesh("soup"), {{"triangles", "1"}, {"seed", "0"}, {"extent", "1"}, {"size", "1"}}},
};

class SceneSchema : public TestFolder {
 protected:
  SceneSchema() : file_(PLUMBLINE_SOURCE_DIR "/tests/scenes/scene.schema.json"), schema_(file_.root()) {
    std::ofstream(root_ / "empty.part.json") << "{}";
    // One texel: uncompressed, 1 x 1, 24 bits
    std::ofstream(root_ / "image.tga", std::ios::binary)
        << std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\30\0\1\2\3", 21);
    std::ofstream(root_ / "mesh.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  }

  JsonNode definition(const std::string& name) const { return name.empty() ? schema_ : schema_["definitions"][name]; }
  /// What a property's schema is, through "$ref".
  JsonNode resolved(JsonNode node) const {
    if (const auto all = node.find("allOf")) node = (*all)[0u];
    const auto ref = node.find("$ref");
    return ref ? resolved(definition(ref->text().substr(std::string("#/definitions/").size()))) : node;
  }
  /// What the loader says, without file and place; "" if it reads the scene.
  std::string said_of(const Sample& sample, const Members& members) const {
    std::string text = sample.scene;
    text.replace(text.find('$'), 1, object(members));
    std::ofstream(root_ / "scene.json") << text;
    try {
      load_scene(root_ / "scene.json", {.asset_folders = {}});
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
  for (const Sample& sample : kSamples) {
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
  for (const Sample& sample : kSamples) here.insert(sample.definition);
  here.erase("");
  EXPECT_EQ(here, objects);
}

TEST_F(SceneSchema, ItsKeysAreReadAndNeededAsItSays) {
  for (const Sample& sample : kSamples) {
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

TEST_F(SceneSchema, ItsValuesAreTheLoaders) {
  for (const Sample& sample : kSamples) {
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
      std::string said = said_of(sample, bad);
      EXPECT_EQ(said.substr(0, expected.size()), expected) << sample.definition << " " << key;
      said.erase(0, expected.size());
      EXPECT_TRUE(said.starts_with(", found ") || expected.ends_with("among"))
          << sample.definition << " " << key << said;
    }
  }
}

}  // namespace
}  // namespace plumbline

#include "capture/files/conventions_file.h"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scene/json/json_file.h"

namespace plumbline {

namespace {

constexpr std::string_view kConventionsFormat = "plumbline conventions";
constexpr int kMostBits = 16;
constexpr std::size_t kMostLines = 1024;

bool is_control(char c) { return (c >= 0 && c < ' ') || c == 0x7f; }

int bits_at(const JsonNode& node) {
  if (node.value().kind == JsonValue::Kind::text && node.value().text == "float") return Conventions::kFloat;
  const auto& value = node.value();
  if (value.kind != JsonValue::Kind::integer || value.integer < 0 || value.integer > kMostBits)
    node.refuse(fmt::format("0 to {}, or \"float\"", kMostBits));
  return static_cast<int>(value.integer);
}

// A key and its texts; without any, nothing. Control characters, and bytes that are no UTF-8, are replaced.
std::string text_array(std::string_view key, std::vector<std::string> texts) {
  for (std::string& text : texts) std::ranges::replace_if(text, is_control, ' ');
  const std::string json = nlohmann::json(texts).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return texts.empty() ? "" : fmt::format(",\n \"{}\": {}", key, json);
}

}  // namespace

Conventions read_conventions(const std::filesystem::path& path) {
  const JsonFile file(path);
  const JsonNode root = file.root();
  std::vector<std::string_view> names = {kSampleWords.name, kOffsetWords.name, kFloatOffsetWords.name};
  each_choice([&](const ConventionWords& words, auto) { names.push_back(words.name); });
  each_number_of_bits([&](const ConventionWords& words, auto) { names.push_back(words.name); });
  std::vector<std::string_view> keys = names;
  keys.insert(keys.end(), {"format", "version", "open", "unexplained", "accepted"});
  root.require_format(kConventionsFormat);
  root.only(keys);
  root["version"].integer(1, 1);
  Conventions out;
  if (const auto node = root.find("sample")) out.sample = node->vector<2>(0, 1);
  if (const auto node = root.find("offset_unit")) out.offset_unit = node->vector<2>(0, 65536);
  if (const auto node = root.find("float_offset_unit")) out.float_offset_unit = node->number(0, 1);
  each_choice([&](const ConventionWords& words, auto member) {
    using Choice = std::remove_cvref_t<decltype(out.*member)>;
    if (const auto node = root.find(words.name)) out.*member = node->choice<Choice>(kNamesOf<Choice>);
  });
  each_number_of_bits([&](const ConventionWords& words, auto member) {
    if (const auto node = root.find(words.name)) out.*member = bits_at(*node);
  });
  // Words that say how a renderer snaps are refused where it does not.
  for (const auto& [key, word] : {std::pair("attribute_corners", "snapped"), std::pair("depth_corners", "snapped"),
                                  std::pair("subpixel_rounding", "down"), std::pair("subpixel_rounding", "up")}) {
    const auto node = root.find(key);
    if (out.subpixel_bits == Conventions::kFloat && node && node->text() == word)
      node->refuse(fmt::format("another value than {}: subpixel_bits is \"float\", nothing is snapped", word));
  }
  const auto read_names = [&](const char* key, std::vector<std::string>& into) {
    const auto node = root.find(key);
    if (!node) return;
    for (const JsonNode& name : node->elements(0, names.size())) {
      if (std::ranges::find(names, name.text()) == names.end()) name.refuse("the name of a convention");
      into.push_back(name.text());
    }
  };
  read_names("open", out.open);
  read_names("accepted", out.accepted);
  if (const auto node = root.find("unexplained")) {
    for (const JsonNode& line : node->elements(0, kMostLines)) {
      if (std::ranges::any_of(line.text(), is_control)) line.refuse("a line without control characters");
      out.unexplained.push_back(line.text());
    }
  }
  return out;
}

std::string conventions_text(const Conventions& c) {
  std::string out = fmt::format(
      "{{\"format\": \"{}\", \"version\": 1,\n \"sample\": [{}, {}],\n \"offset_unit\": [{}, {}],\n "
      "\"float_offset_unit\": {}",
      kConventionsFormat, c.sample.x, c.sample.y, c.offset_unit.x, c.offset_unit.y, c.float_offset_unit);
  each_number_of_bits([&](const ConventionWords& words, auto member) {
    const std::string text = bits_text(c.*member);
    out += fmt::format(",\n \"{}\": {}", words.name, c.*member == Conventions::kFloat ? "\"float\"" : text);
  });
  each_choice([&](const ConventionWords& words, auto member) {
    out += fmt::format(",\n \"{}\": \"{}\"", words.name, name_of(c.*member));
  });
  return out + text_array("open", c.open) + text_array("unexplained", c.unexplained) +
         text_array("accepted", c.accepted) + "}\n";
}

}  // namespace plumbline

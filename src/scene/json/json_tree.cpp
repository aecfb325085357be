#include "scene/json/json_tree.h"

#include <algorithm>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/did_you_mean.h"

namespace plumbline {
namespace {

/// Control characters, C0 and C1, as JSON writes them, so that a message cannot steer a terminal. `text`: UTF-8.
std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t at) { return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u; };
    const bool of_c1 = byte(i) == 0xc2 && byte(i + 1) >= 0x80 && byte(i + 1) < 0xa0;
    if (byte(i) < 0x20 || byte(i) == 0x7f || of_c1)
      out += fmt::format("\\u{:04x}", byte(of_c1 ? ++i : i));
    else
      out += text[i];
  }
  return out;
}

std::string describe(const JsonValue& value) {
  using Kind = JsonValue::Kind;
  switch (value.kind) {
    case Kind::null: return "null";
    case Kind::boolean: return value.boolean ? "true" : "false";
    case Kind::integer: return fmt::format("{}", value.integer);
    case Kind::real: {
      const std::string number = fmt::format("{}", value.real);
      return number.find_first_of(".e") == number.npos ? number + ".0" : number;  // 16.0 is not the integer 16
    }
    case Kind::text:
      return value.text.size() <= 60 ? fmt::format("\"{}\"", value.text)
                                     : fmt::format("a string of {} bytes", value.text.size());
    case Kind::array: return fmt::format("an array of {}", value.items.size());
    case Kind::object: return fmt::format("an object of {} keys", value.members.size());
  }
  return "nothing";
}

}  // namespace

JsonError::JsonError(const std::string& file, const std::string& pointer, std::string_view expected,
                     std::string_view found)
    : std::runtime_error(fmt::format("{}: {}expected {}, found {}", file,
                                     pointer.empty() ? "" : fmt::format("at \"{}\": ", printable(pointer)),
                                     printable(expected), printable(found))) {}

bool JsonValue::operator==(const JsonValue& other) const {
  return kind == other.kind && boolean == other.boolean && integer == other.integer && real == other.real &&
         text == other.text && items == other.items && members == other.members;
}

std::string pointer_token(std::string_view key) {
  std::string escaped = "/";
  for (const char c : key) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += c;
  }
  return escaped;
}

void JsonNode::refuse(std::string_view expected) const { refuse(expected, describe(*value_)); }
void JsonNode::refuse(std::string_view expected, std::string_view found) const {
  throw JsonError(*value_->file, pointer_, expected, found);
}

std::string JsonNode::pointer_to(std::string_view key) const { return pointer_ + pointer_token(key); }

void JsonNode::only(std::span<const std::string_view> keys) const {
  const std::string names = keys.size() == 0 ? std::string("none") : fmt::format("{}", fmt::join(keys, ", "));
  if (value_->kind != JsonValue::Kind::object) refuse(fmt::format("an object with keys among {}", names));
  for (const auto& [key, member] : value_->members) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    throw JsonError(*member.file, pointer_to(key), fmt::format("a key among {}", names),
                    fmt::format("the unknown key \"{}\"{}", key, did_you_mean(key, {keys.begin(), keys.size()})));
  }
}

void JsonNode::require_format(std::string_view name) const {
  const auto format = find("format");
  if (!format) refuse(fmt::format("a file of \"format\": \"{}\"", name), "no such key");
  if (format->text() != name) format->refuse(fmt::format("\"{}\"", name));
}

std::string_view JsonNode::one_of(std::initializer_list<std::string_view> keys) const {
  only(keys);
  if (value_->members.size() != 1) {
    std::vector<std::string_view> given;
    for (const auto& [key, member] : value_->members) given.push_back(key);
    refuse(fmt::format("exactly one of the keys {}", fmt::join(keys, ", ")),
           given.empty() ? "none" : fmt::format("{}", fmt::join(given, ", ")));
  }
  return value_->members.begin()->first;
}

JsonNode JsonNode::operator[](std::string_view key) const {
  if (std::optional<JsonNode> node = find(key)) return *node;
  throw JsonError(*value_->file, pointer_to(key), "a value", "nothing: the key is missing");
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  if (value_->kind != JsonValue::Kind::object) refuse("an object");
  const auto member = value_->members.find(key);
  if (member == value_->members.end()) return std::nullopt;
  return JsonNode{member->second, pointer_to(key)};
}

std::size_t JsonNode::size() const {
  if (value_->kind != JsonValue::Kind::array) refuse("an array");
  return value_->items.size();
}

JsonNode JsonNode::operator[](std::size_t index) const {
  return {value_->items.at(index), fmt::format("{}/{}", pointer_, index)};
}

std::vector<JsonNode> JsonNode::elements(std::size_t least, std::size_t most) const {
  const bool array = value_->kind == JsonValue::Kind::array;
  if (!array || value_->items.size() < least || value_->items.size() > most) {
    if (least == most) refuse(fmt::format("an array of {}", least));
    if (most == SIZE_MAX) refuse(fmt::format("an array of {} or more", least));
    refuse(fmt::format("an array of {} to {}", least, most));
  }
  std::vector<JsonNode> nodes;
  nodes.reserve(size());
  for (std::size_t i = 0; i < size(); ++i) nodes.push_back((*this)[i]);
  return nodes;
}

double JsonNode::number(double lo, double hi) const {
  const bool is_number = value_->kind == JsonValue::Kind::integer || value_->kind == JsonValue::Kind::real;
  if (!is_number || !(value_->real >= lo && value_->real <= hi)) {
    refuse(lo == hi ? fmt::format("{}", lo) : fmt::format("a number from {} to {}", lo, hi));
  }
  return value_->real;
}

std::int64_t JsonNode::integer(std::int64_t lo, std::int64_t hi) const {
  if (value_->kind != JsonValue::Kind::integer || value_->integer < lo || value_->integer > hi) {
    refuse(lo == hi ? fmt::format("{}", lo) : fmt::format("an integer from {} to {}", lo, hi));
  }
  return value_->integer;
}

bool JsonNode::boolean() const {
  if (value_->kind != JsonValue::Kind::boolean) refuse("true or false");
  return value_->boolean;
}

const std::string& JsonNode::text() const {
  if (value_->kind != JsonValue::Kind::text || value_->text.empty()) refuse("a string that is not empty");
  return value_->text;
}

std::size_t JsonNode::index_among(std::span<const std::string_view> names) const {
  const auto found = std::ranges::find(names, std::string_view(value_->text));
  if (value_->kind != JsonValue::Kind::text || found == names.end()) refuse_choice({names.begin(), names.end()});
  return static_cast<std::size_t>(found - names.begin());
}

void JsonNode::refuse_choice(const std::vector<std::string_view>& names) const {
  const bool text = value_->kind == JsonValue::Kind::text;
  refuse(fmt::format("one of {}", fmt::join(names, ", ")),
         describe(*value_) + (text ? did_you_mean(value_->text, names) : ""));
}

}  // namespace plumbline

#include "scene/json_tree.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace plumbline {
namespace {

[[noreturn]] void fail(const std::string& file, const std::string& pointer, std::string_view expected,
                       std::string_view found) {
  throw JsonError(fmt::format("{}: at \"{}\": expected {}, found {}", file, pointer, expected, found));
}

/// One reference token of a JSON pointer (RFC 6901).
std::string token(std::string_view key) {
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

std::string describe(const JsonValue& value) {
  using Kind = JsonValue::Kind;
  switch (value.kind) {
    case Kind::null: return "null";
    case Kind::boolean: return value.boolean ? "true" : "false";
    case Kind::integer: return fmt::format("{}", value.integer);
    case Kind::real: return fmt::format("{}", value.real);
    case Kind::text:
      return value.text.size() <= 60 ? fmt::format("\"{}\"", value.text)
                                     : fmt::format("a string of {} bytes", value.text.size());
    case Kind::array: return fmt::format("an array of {}", value.items.size());
    case Kind::object: return fmt::format("an object of {} keys", value.members.size());
  }
  return "nothing";
}

/// Builds the tree from the parser's events, so that it knows the place of whatever the parser refuses.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  Builder(const std::string& file, JsonValue& root) : file_(file), root_(root) {}

  bool null() override { return add({}); }
  bool boolean(bool v) override { return add({.kind = JsonValue::Kind::boolean, .boolean = v}); }
  bool number_integer(std::int64_t v) override {
    return add({.kind = JsonValue::Kind::integer, .integer = v, .real = static_cast<double>(v)});
  }
  bool number_unsigned(std::uint64_t v) override {
    if (v <= INT64_MAX) return number_integer(static_cast<std::int64_t>(v));
    return add({.kind = JsonValue::Kind::real, .real = static_cast<double>(v)});
  }
  bool number_float(double v, const std::string&) override { return add({.kind = JsonValue::Kind::real, .real = v}); }
  bool string(std::string& v) override { return add({.kind = JsonValue::Kind::text, .text = std::move(v)}); }
  bool binary(nlohmann::json::binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open({.kind = JsonValue::Kind::object}); }
  bool start_array(std::size_t) override { return open({.kind = JsonValue::Kind::array}); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& k) override {
    keys_.back() = k;
    if (open_.back()->members.contains(k)) fail(file_, pointer(), "each key once", "it twice");
    return true;
  }

  bool parse_error(std::size_t, const std::string& last, const nlohmann::json::exception& error) override {
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow) fail(file_, pointer(), "a finite number", last);
    const std::string_view what = error.what();
    const std::size_t prefix = what.find("] ");
    fail(file_, pointer(), "JSON", prefix == what.npos ? what : what.substr(prefix + 2));
  }

 private:
  JsonValue& place(JsonValue value) {
    if (open_.empty()) return root_ = std::move(value);
    JsonValue& parent = *open_.back();
    if (parent.kind == JsonValue::Kind::array) return parent.items.emplace_back(std::move(value));
    return parent.members[keys_.back()] = std::move(value);
  }
  bool add(JsonValue value) {
    place(std::move(value));
    return true;
  }
  bool open(JsonValue value) {
    constexpr std::size_t kDeepest = 64;
    if (open_.size() == kDeepest) fail(file_, pointer(), "at most 64 levels of nesting", "more");
    open_.push_back(&place(std::move(value)));
    keys_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }
  /// The place of the value that comes next.
  std::string pointer() const {
    std::string p;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      if (open_[i]->kind == JsonValue::Kind::object)
        p += token(keys_[i]);
      else
        p += fmt::format("/{}", open_[i]->items.size() - (i + 1 < open_.size() ? 1 : 0));
    }
    return p;
  }

  const std::string& file_;
  JsonValue& root_;
  std::vector<JsonValue*> open_;   ///< the arrays and objects around the next value, outermost first
  std::vector<std::string> keys_;  ///< beside open_: an object's last key
};

std::string join(std::initializer_list<std::string_view> keys) { return fmt::format("{}", fmt::join(keys, ", ")); }

}  // namespace

void JsonNode::refuse(std::string_view expected) const { refuse(expected, describe(*value_)); }
void JsonNode::refuse(std::string_view expected, std::string_view found) const {
  fail(*file_, pointer_, expected, found);
}

std::string JsonNode::pointer_to(std::string_view key) const { return pointer_ + token(key); }

void JsonNode::only(std::initializer_list<std::string_view> keys) const {
  if (value_->kind != JsonValue::Kind::object) refuse(fmt::format("an object with keys among {}", join(keys)));
  for (const auto& [key, member] : value_->members) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    fail(*file_, pointer_to(key), fmt::format("a key among {}", join(keys)),
         fmt::format("the unknown key \"{}\"", key));
  }
}

std::string_view JsonNode::one_of(std::initializer_list<std::string_view> keys) const {
  only(keys);
  if (value_->members.size() != 1) refuse(fmt::format("exactly one of the keys {}", join(keys)));
  return value_->members.begin()->first;
}

JsonNode JsonNode::operator[](std::string_view key) const {
  if (std::optional<JsonNode> node = find(key)) return *node;
  fail(*file_, pointer_to(key), "a value", "nothing: the key is missing");
}

std::optional<JsonNode> JsonNode::find(std::string_view key) const {
  if (value_->kind != JsonValue::Kind::object) refuse("an object");
  const auto member = value_->members.find(key);
  if (member == value_->members.end()) return std::nullopt;
  return JsonNode{member->second, *file_, pointer_to(key)};
}

std::size_t JsonNode::size() const {
  if (value_->kind != JsonValue::Kind::array) refuse("an array");
  return value_->items.size();
}

JsonNode JsonNode::operator[](std::size_t index) const {
  return {value_->items.at(index), *file_, fmt::format("{}/{}", pointer_, index)};
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
    refuse(fmt::format("a number from {} to {}", lo, hi));
  }
  return value_->real;
}

std::int64_t JsonNode::integer(std::int64_t lo, std::int64_t hi) const {
  if (value_->kind != JsonValue::Kind::integer || value_->integer < lo || value_->integer > hi) {
    refuse(fmt::format("an integer from {} to {}", lo, hi));
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

JsonFile::JsonFile(const std::filesystem::path& path) : name_(path.string()) {
  if (!std::filesystem::exists(path)) fail(name_, "", "a JSON file", "nothing: there is no such file");
  if (!std::filesystem::is_regular_file(path)) fail(name_, "", "a JSON file", "something that is not a file");
  std::ifstream in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) fail(name_, "", "a JSON file", "one that cannot be read");
  Builder builder(name_, value_);
  constexpr bool kStrict = true, kIgnoreComments = true;
  nlohmann::json::sax_parse(text, &builder, nlohmann::json::input_format_t::json, kStrict, kIgnoreComments);
}

}  // namespace plumbline

#include "scene/json/json_file.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace plumbline {
namespace {

/// The parser's message without its code and its prefixes: "[json.exception.parse_error.101] parse error at line 1,
/// column 2: syntax error while parsing value - invalid literal" is "a syntax error at line 1, column 2, in value:
/// invalid literal".
std::string plain_text(std::string message) {
  constexpr std::string_view kReplaced[][2] = {
      {"parse error at ", "a syntax error at "}, {": syntax error while parsing ", ", in "}, {" - ", ": "}};
  message.erase(0, message.find("] ") + 2);
  for (const auto& [from, to] : kReplaced) {
    if (const std::size_t at = message.find(from); at != message.npos) message.replace(at, from.size(), to);
  }
  return message;
}

/// Builder of the tree from the parser's events; errors of the parser can so name their JSON pointer.
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
    if (open_.back()->members.contains(k)) refuse("each key once", "it twice");
    return true;
  }

  bool parse_error(std::size_t, const std::string& last, const nlohmann::json::exception& error) override {
    constexpr int kNumberOverflow = 406;
    if (error.id == kNumberOverflow) refuse("a finite number", last);
    refuse("JSON", plain_text(error.what()));
  }

 private:
  [[noreturn]] void refuse(std::string_view expected, std::string_view found) const {
    throw JsonError(file_, pointer(), expected, found);
  }
  JsonValue& place(JsonValue value) {
    value.file = &file_;
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
    if (open_.size() == kDeepest) refuse("at most 64 levels of nesting", "more");
    open_.push_back(&place(std::move(value)));
    keys_.emplace_back();
    return true;
  }
  bool close() {
    open_.pop_back();
    keys_.pop_back();
    return true;
  }
  /// JSON pointer of the value that comes next.
  std::string pointer() const {
    std::string p;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const bool object = open_[i]->kind == JsonValue::Kind::object;
      if (object && keys_[i].empty() && open_[i]->members.empty()) break;  // before its first key
      if (object)
        p += pointer_token(keys_[i]);
      else
        p += fmt::format("/{}", open_[i]->items.size() - (i + 1 < open_.size() ? 1 : 0));
    }
    return p;
  }

  const std::string& file_;
  JsonValue& root_;
  std::vector<JsonValue*> open_;   ///< the arrays and objects around the next value, outermost first
  std::vector<std::string> keys_;  ///< one per entry of open_: the last key of an object
};

}  // namespace

JsonValue read_json_file(const std::filesystem::path& path, const std::string& name, std::size_t most_bytes) {
  const auto refuse = [&](std::string_view expected, std::string_view found) {
    throw JsonError(name, "", expected, found);
  };
  if (!std::filesystem::exists(path)) refuse("a JSON file", "nothing: there is no such file");
  if (!std::filesystem::is_regular_file(path)) refuse("a JSON file", "something that is not a file");
  std::ifstream in(path, std::ios::binary);
  std::string text(std::min<std::uintmax_t>(std::filesystem::file_size(path), most_bytes + 1), '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!in) refuse("a JSON file", "one that cannot be read");
  if (text.size() > most_bytes) refuse(fmt::format("JSON of at most {} bytes", most_bytes), "more");
  // The parser would end at a NUL byte.
  if (const std::size_t at = text.find('\0'); at != text.npos) {
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    refuse("JSON", fmt::format("a NUL byte in line {}", line));
  }
  // The parser would skip a byte order mark; other readers of the same file would not.
  if (text.starts_with("\xef\xbb\xbf")) refuse("JSON in UTF-8 without a byte order mark", "the mark");

  JsonValue root;
  Builder builder(name, root);
  constexpr bool kStrict = true, kIgnoreComments = true;
  nlohmann::json::sax_parse(text, &builder, nlohmann::json::input_format_t::json, kStrict, kIgnoreComments);
  return root;
}

}  // namespace plumbline

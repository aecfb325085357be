// JSON that knows its place: whatever is refused is refused with the file, the JSON pointer, what was expected and what
// was found.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline {

/// The message is: file: at "JSON pointer": expected ..., found ... (control characters as JSON writes them)
struct JsonError : std::runtime_error {
  JsonError(const std::string& file, const std::string& pointer, std::string_view expected, std::string_view found);
};

struct JsonValue {
  enum class Kind { null, boolean, integer, real, text, array, object };
  Kind kind = Kind::null;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0;  ///< of an integer, too
  std::string text{};
  std::vector<JsonValue> items{};                           ///< of an array
  std::map<std::string, JsonValue, std::less<>> members{};  ///< of an object
  const std::string* file = nullptr;                        ///< where it was written; owned by who read it

  /// Equal in content, wherever written.
  bool operator==(const JsonValue& other) const;
};

/// One reference token of a JSON pointer, with its slash (RFC 6901).
std::string pointer_token(std::string_view key);

/// A value at its place in a file; refers to the tree that it came from. Every reader throws JsonError.
class JsonNode {
 public:
  JsonNode(const JsonValue& value, std::string pointer) : value_(&value), pointer_(std::move(pointer)) {}

  const JsonValue& value() const { return *value_; }

  /// Refuses anything but an object all of whose keys are among these.
  void only(std::span<const std::string_view> keys) const;
  void only(std::initializer_list<std::string_view> keys) const { only(std::span(keys.begin(), keys.size())); }
  /// Refuses anything but an object that holds exactly one key, one of these; returns it.
  std::string_view one_of(std::initializer_list<std::string_view> keys) const;
  JsonNode operator[](std::string_view key) const;
  std::optional<JsonNode> find(std::string_view key) const;

  std::size_t size() const;  ///< of an array
  JsonNode operator[](std::size_t index) const;
  /// An array's elements, from `least` to `most` of them.
  std::vector<JsonNode> elements(std::size_t least, std::size_t most) const;

  double number(double lo, double hi) const;
  std::int64_t integer(std::int64_t lo, std::int64_t hi) const;
  bool boolean() const;
  const std::string& text() const;  ///< not empty
  template <int N>
  glm::vec<N, double> vector(double lo, double hi) const {
    const std::vector<JsonNode> parts = elements(N, N);
    glm::vec<N, double> v;
    for (int i = 0; i < N; ++i) v[i] = parts[static_cast<std::size_t>(i)].number(lo, hi);
    return v;
  }
  template <class E>
  E choice(std::initializer_list<std::pair<std::string_view, E>> choices) const {
    std::vector<std::string_view> names;
    for (const auto& [name, e] : choices) {
      if (value_->kind == JsonValue::Kind::text && value_->text == name) return e;
      names.push_back(name);
    }
    refuse_choice(names);
  }

  /// The enumerator whose name it is; `names` in the order of their values.
  template <class E>
  E choice(std::span<const std::string_view> names) const {
    return static_cast<E>(index_among(names));
  }

  /// Refuses the value as found.
  [[noreturn]] void refuse(std::string_view expected) const;
  [[noreturn]] void refuse(std::string_view expected, std::string_view found) const;

 private:
  std::string pointer_to(std::string_view key) const;
  std::size_t index_among(std::span<const std::string_view> names) const;
  [[noreturn]] void refuse_choice(const std::vector<std::string_view>& names) const;

  const JsonValue* value_;
  std::string pointer_;
};

}  // namespace plumbline

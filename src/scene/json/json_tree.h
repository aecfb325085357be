// JSON trees whose values know their file and JSON pointer. Errors name both, what was expected and what was found.
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
  double real = 0;  ///< set for an integer, too
  std::string text{};
  std::vector<JsonValue> items{};                           ///< of an array
  std::map<std::string, JsonValue, std::less<>> members{};  ///< of an object
  const std::string* file = nullptr;                        ///< name of its file; owned by the reader of the tree

  /// Equal in content, wherever written.
  bool operator==(const JsonValue& other) const;
};

/// One reference token of a JSON pointer, with its slash (RFC 6901).
std::string pointer_token(std::string_view key);

/// A value and its JSON pointer; refers to the tree, which has to outlive the node. Every function that reads the value
/// throws JsonError where the value is not as asked for.
class JsonNode {
 public:
  JsonNode(const JsonValue& value, std::string pointer) : value_(&value), pointer_(std::move(pointer)) {}

  const JsonValue& value() const { return *value_; }

  /// Requires an object all of whose keys are among `keys`.
  void only(std::span<const std::string_view> keys) const;
  void only(std::initializer_list<std::string_view> keys) const { only(std::span(keys.begin(), keys.size())); }
  /// Requires an object whose key `format` is `name`.
  void require_format(std::string_view name) const;
  /// Requires an object of exactly one key, one of `keys`; returns the key.
  std::string_view one_of(std::initializer_list<std::string_view> keys) const;
  JsonNode operator[](std::string_view key) const;           ///< the member of an object, which must have it
  std::optional<JsonNode> find(std::string_view key) const;  ///< the member of an object; nullopt: no such key

  std::size_t size() const;                      ///< of an array
  JsonNode operator[](std::size_t index) const;  ///< element of an array; throws std::out_of_range
  /// An array's elements, from `least` to `most` of them.
  std::vector<JsonNode> elements(std::size_t least, std::size_t most) const;

  double number(double lo, double hi) const;                     ///< in [lo, hi]
  std::int64_t integer(std::int64_t lo, std::int64_t hi) const;  ///< in [lo, hi], written without point or exponent
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

  /// The enumerator that the text names; `names` in the order of the enumerators' values.
  template <class E>
  E choice(std::span<const std::string_view> names) const {
    return static_cast<E>(index_among(names));
  }

  /// Throws JsonError. `found`: without it, the value's own description.
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

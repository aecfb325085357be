// JSON as text, written from the inside out: a value is a string.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::campaign {

/// Number of at most nine significant digits; -0 is written as 0.
std::string json(double number);
/// String in quotes. `text`: without characters that JSON escapes.
std::string json_string(std::string_view text);
std::string json_array(const std::vector<std::string>& values);
std::string json_numbers(const std::vector<double>& numbers);

/// An object that grows; its members stand in the order in which they were put.
class Object {
 public:
  Object() = default;
  /// One member.
  Object(std::string_view key, const std::string& value) { put(key, value); }
  Object& put(std::string_view key, const std::string& value);
  Object& put(std::string_view key, const Object& value) { return put(key, value.text()); }
  Object& put(std::string_view key, double number) { return put(key, json(number)); }
  Object& put_word(std::string_view key, std::string_view word) { return put(key, json_string(word)); }
  Object& put_numbers(std::string_view key, const std::vector<double>& v) { return put(key, json_numbers(v)); }
  bool has(std::string_view key) const;
  bool empty() const { return members_.empty(); }
  std::string text() const;
  /// A file: one line for each member.
  std::string lines() const;

 private:
  struct Member {
    std::string key, value;
  };
  std::vector<Member> members_;
};

/// Array with a line for each object, for a member of Object::lines().
std::string json_lines(const std::vector<Object>& objects);

}  // namespace plumbline::campaign

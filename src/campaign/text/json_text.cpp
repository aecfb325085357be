#include "campaign/text/json_text.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace plumbline::campaign {

std::string json(double number) { return fmt::format("{:.9g}", number == 0 ? 0 : number); }

std::string json_string(std::string_view text) { return fmt::format("\"{}\"", text); }

std::string json_array(const std::vector<std::string>& values) { return fmt::format("[{}]", fmt::join(values, ", ")); }

std::string json_numbers(const std::vector<double>& numbers) {
  std::vector<std::string> values;
  for (const double number : numbers) values.push_back(json(number));
  return json_array(values);
}

bool Object::has(std::string_view key) const {
  return std::ranges::any_of(members_, [&](const Member& m) { return m.key == key; });
}

Object& Object::put(std::string_view key, const std::string& value) {
  const auto known = std::ranges::find(members_, key, &Member::key);
  if (known == members_.end()) {
    members_.push_back({std::string(key), value});
  } else {
    known->value = value;
  }
  return *this;
}

std::string Object::text() const {
  std::vector<std::string> members;
  for (const Member& m : members_) members.push_back(json_string(m.key) + ": " + m.value);
  return fmt::format("{{{}}}", fmt::join(members, ", "));
}

std::string Object::lines() const {
  std::vector<std::string> out;
  for (const Member& m : members_) out.push_back(fmt::format("  {}: {}", json_string(m.key), m.value));
  return fmt::format("{{\n{}\n}}\n", fmt::join(out, ",\n"));
}

std::string json_lines(const std::vector<Object>& objects) {
  std::vector<std::string> out;
  for (const Object& object : objects) out.push_back("    " + object.text());
  return fmt::format("[\n{}\n  ]", fmt::join(out, ",\n"));
}

}  // namespace plumbline::campaign

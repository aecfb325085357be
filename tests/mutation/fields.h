// Fields of a text, and numbers in them.
#pragma once

#include <charconv>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace plumbline::mutation {

/// The fields of `text` between separators `by`: at least one; empty ones count.
inline std::vector<std::string> fields_of(std::string_view text, char by) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (c == by) {
      out.emplace_back();
    } else {
      out.back().push_back(c);
    }
  }
  return out;
}

/// The number that all of `digits` are, to this base. Throws std::runtime_error, "PLACE: expected a number of base N".
inline std::uint64_t number_of(std::string_view digits, int base, std::string_view place) {
  std::uint64_t out = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out, base);
  if (error == std::errc() && end == digits.data() + digits.size()) return out;
  throw std::runtime_error(fmt::format("{}: expected a number of base {}, found \"{}\"", place, base, digits));
}

}  // namespace plumbline::mutation

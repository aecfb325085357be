// Fields of a text, separated by a character.
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

}  // namespace plumbline::mutation

#include "base/did_you_mean.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace plumbline {

namespace {

/// Levenshtein's distance: letters put in, left out or replaced.
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0u);
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t before = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = before + (a[i] != b[j]);
      before = row[j + 1];
      row[j + 1] = std::min({replaced, before + 1, row[j] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string did_you_mean(std::string_view word, std::span<const std::string_view> names) {
  constexpr std::size_t kLongest = 40;
  if (word.size() > kLongest || names.empty()) return "";
  constexpr std::size_t kFewest = 4;  // letters that a name begins with
  const auto begins = [&](std::string_view name) { return name.starts_with(word); };
  const auto longer = std::ranges::find_if(names, begins);
  if (word.size() >= kFewest && std::ranges::count_if(names, begins) == 1)
    return fmt::format(" (did you mean \"{}\"?)", *longer);
  const auto nearest = std::min_element(names.begin(), names.end(), [&](std::string_view a, std::string_view b) {
    return distance(word, a) < distance(word, b);
  });
  const std::size_t far = distance(word, *nearest);
  return far <= 3 && 2 * far <= nearest->size() ? fmt::format(" (did you mean \"{}\"?)", *nearest) : "";
}

}  // namespace plumbline

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "scene/mesh_check.h"
#include "scene/text_scan.h"

namespace plumbline {
namespace {

/// How many numbers follow, each of which assimp's reader takes for one.
int count_numbers(std::string_view line) {
  int count = 0;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++count) {
    const bool point_first = word.front() == '.';
    const auto number = number_in<double>(word);
    if (!number || point_first) {
      throw std::runtime_error(fmt::format("expected a number that begins with a sign or a digit, found \"{}\"", word));
    }
  }
  return count;
}

void check_face(std::string_view line) {
  int corners = 0;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++corners) {
    if (word.find_first_not_of("0123456789/-") != word.npos) {
      throw std::runtime_error(fmt::format("expected a corner such as 1, 1/2, 1//3 or 1/2/3, found \"{}\"", word));
    }
  }
  if (corners < 3) throw std::runtime_error(fmt::format("expected a face of three corners or more, found {}", corners));
}

}  // namespace

void check_obj(std::string_view text) {
  constexpr std::array<std::string_view, 9> kHarmless = {"vn", "vt", "g", "o", "s", "mg", "mtllib", "usemtl", ""};
  int numbers_of_all = 0;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    line = line.substr(0, line.find('#'));
    const std::string_view statement = take_word(line);
    try {
      if (statement == "v") {
        const int numbers = count_numbers(line);
        if (numbers != 3 && numbers != 4 && numbers != 6) {
          throw std::runtime_error(fmt::format("expected v with 3, 4 or 6 numbers, found {}", numbers));
        }
        if (numbers_of_all != 0 && numbers != numbers_of_all) {
          throw std::runtime_error(
              fmt::format("expected v with {} numbers as in the lines before, found {}", numbers_of_all, numbers));
        }
        numbers_of_all = numbers;
      } else if (statement == "f") {
        check_face(line);
      } else if (std::find(kHarmless.begin(), kHarmless.end(), statement) == kHarmless.end()) {
        throw std::runtime_error(
            fmt::format("expected v, vn, vt, f, g, o, s, mtllib or usemtl, found \"{}\"", statement.substr(0, 40)));
      }
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{} in line {}", error.what(), number));
    }
  }
}

}  // namespace plumbline

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/mesh/import/mesh_check.h"
#include "scene/mesh/import/refuse.h"
#include "scene/mesh/import/text_scan.h"

namespace plumbline {
namespace {

/// The numbers of a line. Refuses words that assimp's reader does not take for a number, such as ".5".
std::vector<double> read_numbers(std::string_view line) {
  std::vector<double> numbers;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
    const bool point_first = word.front() == '.';
    const auto number = number_in<double>(word);
    if (!number || point_first) {
      refuse("a number that begins with a sign or a digit", fmt::format("\"{}\"", word));
    }
    numbers.push_back(*number);
  }
  return numbers;
}

/// Counts of v, vt and vn statements, in the order of a corner's indices.
using Counts = std::array<std::int64_t, 3>;
constexpr std::array<std::string_view, 3> kIndexed = {"v", "vt", "vn"};

void count(std::string_view statement, Counts& counts) {
  for (std::size_t i = 0; i < kIndexed.size(); ++i) counts[i] += statement == kIndexed[i] ? 1 : 0;
}

Counts count_all(std::string_view text) {
  Counts counts{};
  while (!text.empty()) {
    std::string_view line = take_line(text);
    count(take_word(line), counts);
  }
  return counts;
}

/// Checks a corner's indices: from 1 up over the whole file, or from -1 down over the statements above the face.
void check_corner(std::string_view corner, const Counts& all, const Counts& above) {
  for (std::size_t i = 0; i < kIndexed.size() && !corner.empty(); ++i) {
    const std::string_view word = corner.substr(0, corner.find('/'));
    corner.remove_prefix(std::min(word.size() + 1, corner.size()));
    if (word.empty()) continue;
    const auto index = number_in<std::int64_t>(word);
    if (!index || *index == 0 || *index > all[i] || *index < -above[i]) {
      refuse(fmt::format("an index of the {} {} that there are", all[i], kIndexed[i]), word);
    }
  }
}

/// Parts of a corner, v, v/vt, v//vn or v/vt/vn, in words.
std::string parts_of(std::string_view corner) {
  std::string out;
  for (std::size_t i = 0; i < kIndexed.size() && !corner.empty(); ++i) {
    const std::string_view word = corner.substr(0, corner.find('/'));
    corner.remove_prefix(std::min(word.size() + 1, corner.size()));
    if (!word.empty()) out += fmt::format("{}{}", out.empty() ? "" : " ", kIndexed[i]);
  }
  return out;
}

/// Refuses corners of different parts, where assimp gives the indices that there are to other corners.
std::string check_face(std::string_view line, const Counts& all, const Counts& above) {
  int corners = 0;
  std::string parts;
  for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++corners) {
    if (word.find_first_not_of("0123456789/-") != word.npos) {
      refuse("a corner such as 1, 1/2, 1//3 or 1/2/3", fmt::format("\"{}\"", word));
    }
    check_corner(word, all, above);
    if (corners == 0) parts = parts_of(word);
    if (parts_of(word) != parts) {
      refuse(fmt::format("corners with {} as the face's first has", parts), fmt::format("\"{}\"", word));
    }
  }
  if (corners < 3) refuse("a face of three corners or more", fmt::format("{}", corners));
  return parts;
}

}  // namespace

std::string check_obj(std::string_view text) {
  constexpr std::array<std::string_view, 8> kHarmlessStatements = {"vn", "g", "o", "s", "mg", "mtllib", "usemtl", ""};
  std::string note;
  std::size_t numbers_of_all = 0;
  bool of_faces[2] = {false, false};  // without vt, with vt
  const Counts all = count_all(text);
  Counts above{};
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    line = line.substr(0, line.find('#'));
    const std::string_view statement = take_word(line);
    count(statement, above);
    try {
      if (statement == "v") {
        const std::size_t numbers = read_numbers(line).size();
        if (numbers != 3 && numbers != 4 && numbers != 6) {
          refuse("v with 3, 4 or 6 numbers", fmt::format("{}", numbers));
        }
        if (numbers_of_all != 0 && numbers != numbers_of_all) {
          refuse(fmt::format("v with {} numbers as in the lines before", numbers_of_all), fmt::format("{}", numbers));
        }
        numbers_of_all = numbers;
      } else if (statement == "vt") {
        const std::vector<double> numbers = read_numbers(line);
        if (numbers.size() != 2 && numbers.size() != 3) {
          refuse("vt with 2 or 3 numbers", fmt::format("{}", numbers.size()));
        }
        if (note.empty() && numbers.size() == 3 && numbers[2] != 0) {
          note = fmt::format("third texture coordinates, as in line {}, are left out: textures have two", number);
        }
      } else if (statement == "f") {
        const bool has_vt = check_face(line, all, above).find("vt") != std::string::npos;
        of_faces[has_vt ? 1 : 0] = true;
        if (note.empty() && of_faces[0] && of_faces[1]) {
          note = fmt::format("faces with and without vt, up to line {}: texture coordinates without are 0", number);
        }
      } else if (std::find(kHarmlessStatements.begin(), kHarmlessStatements.end(), statement) ==
                 kHarmlessStatements.end()) {
        refuse("v, vn, vt, f, g, o, s, mtllib or usemtl", fmt::format("\"{}\"", statement.substr(0, 40)));
      }
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{} in line {}", error.what(), number));
    }
  }
  return note;
}

}  // namespace plumbline

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/mesh/import/mesh_check.h"
#include "scene/mesh/import/refuse.h"
#include "scene/mesh/import/text_scan.h"

namespace plumbline {
namespace {

struct Property {
  std::string name;
  std::size_t size = 0;        ///< bytes of the value, or of a list's element
  std::size_t count_size = 0;  ///< bytes of a list's count; 0: no list
  bool count_has_sign = false;
  bool integer = false, has_sign = false;
};
struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
};
enum class Format { ascii, little, big };
struct Header {
  Format format = Format::ascii;
  std::vector<Element> elements;
};

std::size_t size_of(std::string_view type, bool integer) {
  constexpr std::pair<std::string_view, std::size_t> kSizes[] = {
      {"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2}, {"int", 4},   {"uint", 4},
      {"int8", 1},  {"uint8", 1},  {"int16", 2},   {"uint16", 2}, {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"double", 8}, {"float32", 4}, {"float64", 8}};
  for (const auto& [name, size] : kSizes) {
    if (name == type && !(integer && (type.starts_with("float") || type == "double"))) return size;
  }
  refuse(integer ? "an integer type of PLY" : "a type of PLY", fmt::format("\"{}\" in the header", type));
}

Format format_of(std::string_view word) {
  if (word == "ascii") return Format::ascii;
  if (word == "binary_little_endian") return Format::little;
  if (word == "binary_big_endian") return Format::big;
  refuse("a PLY format, ascii, binary_little_endian or binary_big_endian", fmt::format("\"{}\"", word));
}

bool is_indices(const Property& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

Property read_property(std::string_view line) {
  Property property;
  std::string_view type = take_word(line);
  if (type == "list") {
    const std::string_view count = take_word(line);
    property.count_size = size_of(count, true);
    property.count_has_sign = !count.starts_with('u');
    type = take_word(line);
  }
  property.size = size_of(type, false);
  property.integer = type.find("int") != type.npos || type.find("char") != type.npos || type.find("short") != type.npos;
  property.has_sign = !type.starts_with('u');
  property.name = take_word(line);
  if (is_indices(property) && !property.integer) {
    refuse(fmt::format("an integer type of PLY for {}", property.name), fmt::format("\"{}\" in the header", type));
  }
  return property;
}

/// Takes the header off the bytes.
Header read_header(std::string_view& bytes) {
  if (take_line(bytes) != "ply") refuse("a PLY file that begins with the line \"ply\"", "another");
  Header header;
  bool format_told = false;
  while (!bytes.empty()) {
    std::string_view line = take_line(bytes);
    const std::string_view word = take_word(line);
    if (word == "end_header") {
      if (!format_told) refuse("a PLY header that tells the format", "none");
      return header;
    }
    if (word == "comment" || word == "obj_info") continue;
    if (word == "format") {
      header.format = format_of(take_word(line));
      format_told = true;
    } else if (word == "element") {
      const std::string_view name = take_word(line), count = take_word(line);
      const auto number = number_in<std::uint32_t>(count);
      if (!number) refuse("an element's count in the PLY header", fmt::format("\"{}\"", count));
      header.elements.push_back({std::string(name), *number, {}});
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(line));
    } else {
      refuse("format, element, property, comment or end_header in the PLY header",
             fmt::format("\"{}\"", word.substr(0, 40)));
    }
  }
  refuse("end_header", "the file's end in its header");
}

void require_positions(const Header& header) {
  for (const std::string_view axis : {"x", "y", "z"}) {
    const auto has_axis = [&](const Element& element) {
      return element.name == "vertex" && std::any_of(element.properties.begin(), element.properties.end(),
                                                     [&](const Property& p) { return p.name == axis; });
    };
    if (std::none_of(header.elements.begin(), header.elements.end(), has_axis)) {
      refuse("vertices with x, y and z in the PLY header", fmt::format("no {}", axis));
    }
  }
}

void check_corners(const Element& element, const Property& property, std::uint64_t row, std::uint64_t corners) {
  if (is_indices(property) && corners < 3) {
    refuse("faces of three corners or more", fmt::format("{} in {} {}", corners, element.name, row));
  }
}

/// Refuses a word that is no value of the property's type; assimp would wrap or truncate it.
void check_value(std::string_view word, const Property& property, const auto& where) {
  if (!number_in<double>(word)) {
    refuse(fmt::format("a number for {}", property.name), fmt::format("\"{}\" in {}", word, where()));
  }
  if (!property.integer) return;
  const std::int64_t values = std::int64_t{1} << 8 * property.size;
  const std::int64_t least = property.has_sign ? -values / 2 : 0, most = least + values - 1;
  const auto number = number_in<std::int64_t>(word);
  if (!number || *number < least || *number > most) {
    refuse(fmt::format("an integer from {} to {} for {}", least, most, property.name),
           fmt::format("\"{}\" in {}", word, where()));
  }
}

void check_row_of_text(std::string_view& text, const Element& element, std::uint64_t row) {
  const auto where = [&] { return fmt::format("{} {} of {}", element.name, row, element.count); };
  if (text.empty())
    refuse(fmt::format("{} of {}", element.count, element.name), fmt::format("{}: a truncated file", row));
  std::string_view line = take_line(text);
  for (const Property& property : element.properties) {
    std::uint64_t values = 1;
    if (property.count_size > 0) {
      const std::string_view word = take_word(line);
      const auto count = number_in<std::uint32_t>(word);
      if (!count) refuse("a list's count", fmt::format("\"{}\" in {}", word, where()));
      check_corners(element, property, row, values = *count);
    }
    for (; values > 0; --values) check_value(take_word(line), property, where);
  }
  if (const std::string_view word = take_word(line); !word.empty()) {
    refuse("the line's end", fmt::format("\"{}\" in {}", word, where()));
  }
}

std::uint64_t read_count(std::string_view bytes, std::size_t size, Format format) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t from = format == Format::little ? size - 1 - i : i;
    count = count << 8 | static_cast<unsigned char>(bytes[from]);
  }
  return count;
}

void check_row_of_bytes(std::string_view& bytes, const Element& element, std::uint64_t row, Format format) {
  const auto take = [&](std::uint64_t size) {
    if (size > bytes.size()) {
      refuse(fmt::format("{} of {}", element.count, element.name), fmt::format("{}: a truncated file", row));
    }
    bytes.remove_prefix(size);
  };
  for (const Property& property : element.properties) {
    std::uint64_t values = 1;
    if (property.count_size > 0) {
      const std::string_view count = bytes.substr(0, property.count_size);
      take(property.count_size);
      values = read_count(count, property.count_size, format);
      if (property.count_has_sign && values >> (8 * property.count_size - 1) != 0) {
        refuse("a list's count", fmt::format("a negative one in {} {} of {}", element.name, row, element.count));
      }
      check_corners(element, property, row, values);
    }
    take(values * property.size);
  }
}

void check_row(std::string_view& bytes, const Element& element, std::uint64_t row, Format format) {
  if (format == Format::ascii)
    check_row_of_text(bytes, element, row);
  else
    check_row_of_bytes(bytes, element, row, format);
}

bool is_strips(const Element& element) { return element.name == "tristrips"; }

void require_strips_alone(const Header& header) {
  std::uint64_t elements = 0;
  for (const Element& element : header.elements) {
    elements += is_strips(element) || element.name == "face";
    if (!is_strips(element)) continue;
    const bool one = element.properties.size() == 1;
    const Property property = one ? element.properties.front() : Property{};
    if (!is_indices(property) || property.count_size == 0) {
      refuse("tristrips with one property, a list vertex_indices of integers", "others");
    }
  }
  if (elements > 1) refuse("faces in one element, face or tristrips", "more");
}

/// Takes a row of a tristrips element off the bytes: its indices.
std::vector<std::int64_t> take_strip(std::string_view& bytes, const Property& property, Format format) {
  std::vector<std::int64_t> indices;
  if (format == Format::ascii) {
    std::string_view line = take_line(bytes);
    take_word(line);  // the count
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      indices.push_back(number_in<std::int64_t>(word).value());  // checked: check_row()
    }
    return indices;
  }
  const auto take = [&](std::size_t size) {
    const std::uint64_t value = read_count(bytes.substr(0, size), size, format);
    bytes.remove_prefix(size);
    return value;
  };
  for (std::uint64_t left = take(property.count_size); left > 0; --left) {
    const std::uint64_t value = take(property.size), sign = std::uint64_t{1} << (8 * property.size - 1);
    const bool negative = property.has_sign && (value & sign) != 0;
    indices.push_back(static_cast<std::int64_t>(negative ? value - 2 * sign : value));
  }
  return indices;
}

using Corners = std::array<std::int64_t, 3>;

void add_triangles(const std::vector<std::int64_t>& strip, std::uint64_t vertices, std::vector<Corners>& triangles) {
  std::size_t first = 0;  // index of the current strip's first corner
  for (std::size_t i = 0; i < strip.size(); ++i) {
    if (strip[i] == -1) {
      first = i + 1;
    } else if (strip[i] < 0 || static_cast<std::uint64_t>(strip[i]) >= vertices) {
      refuse(fmt::format("vertices below {} in tristrips, or -1", vertices), fmt::format("{}", strip[i]));
    } else if (i >= first + 2) {
      const bool turned = (i - first) % 2 == 1;
      triangles.push_back({strip[i - (turned ? 1 : 2)], strip[i - (turned ? 2 : 1)], strip[i]});
    }
  }
}

std::string rows_of(const std::vector<Corners>& triangles, Format format) {
  std::string rows;
  for (const Corners& t : triangles) {
    if (format == Format::ascii) {
      rows += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
      continue;
    }
    rows += '\3';
    for (const std::int64_t index : t) {
      for (int i = 0; i < 4; ++i) rows += static_cast<char>(index >> 8 * (format == Format::little ? i : 3 - i));
    }
  }
  return rows;
}

/// The header's lines with the strips' element replaced by `faces` faces.
std::string header_with_faces(std::string_view header, std::size_t faces) {
  std::string out;
  bool in_strips = false;
  while (!header.empty()) {
    const std::string_view line = take_line(header);
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    if (word == "element") in_strips = take_word(rest) == "tristrips";
    if (!in_strips || word == "end_header") {
      out += fmt::format("{}\n", line);
    } else if (word == "element") {
      out += fmt::format("element face {}\nproperty list uchar int vertex_indices\n", faces);
    }
  }
  return out;
}

}  // namespace

void check_ply(std::string_view bytes) {
  const Header header = read_header(bytes);
  require_positions(header);
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0) refuse("properties", fmt::format("none of {}", element.name));
    for (std::uint64_t row = 0; row < element.count; ++row) check_row(bytes, element, row, header.format);
  }
  if (bytes.find_first_not_of(" \t\r\n") != bytes.npos) {
    refuse("the file's end after its last element", fmt::format("{} bytes more", bytes.size()));
  }
}

std::string with_faces_for_strips(std::string_view bytes) {
  std::string_view rest = bytes;
  const Header header = read_header(rest);
  if (std::ranges::none_of(header.elements, is_strips)) return std::string(bytes);
  require_strips_alone(header);
  const std::string_view head = bytes.substr(0, bytes.size() - rest.size());
  std::string rows;
  std::uint64_t vertices = 0;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") vertices = element.count;
  }
  std::vector<Corners> triangles;
  for (const Element& element : header.elements) {
    const std::string_view from = rest;
    for (std::uint64_t row = 0; row < element.count; ++row) {
      if (is_strips(element))
        add_triangles(take_strip(rest, element.properties.front(), header.format), vertices, triangles);
      else
        check_row(rest, element, row, header.format);
    }
    rows += is_strips(element) ? rows_of(triangles, header.format) : from.substr(0, from.size() - rest.size());
  }
  return header_with_faces(head, triangles.size()) + rows;
}

}  // namespace plumbline

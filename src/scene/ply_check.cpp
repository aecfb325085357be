#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/mesh_check.h"
#include "scene/text_scan.h"

namespace plumbline {
namespace {

struct Property {
  std::string name;
  std::size_t size = 0;        ///< bytes of the value, or of each of a list's
  std::size_t count_size = 0;  ///< bytes of a list's count; 0: no list
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

[[noreturn]] void bad_ply(std::string_view expected, std::string_view found) {
  throw std::runtime_error(fmt::format("expected {}, found {}", expected, found));
}

std::size_t size_of(std::string_view type, bool integer) {
  constexpr std::pair<std::string_view, std::size_t> kSizes[] = {
      {"char", 1},  {"uchar", 1},  {"short", 2},   {"ushort", 2}, {"int", 4},   {"uint", 4},
      {"int8", 1},  {"uint8", 1},  {"int16", 2},   {"uint16", 2}, {"int32", 4}, {"uint32", 4},
      {"float", 4}, {"double", 8}, {"float32", 4}, {"float64", 8}};
  for (const auto& [name, size] : kSizes) {
    if (name == type && !(integer && (type.starts_with("float") || type == "double"))) return size;
  }
  bad_ply(integer ? "an integer type of PLY" : "a type of PLY", fmt::format("\"{}\" in the header", type));
}

Format format_of(std::string_view word) {
  if (word == "ascii") return Format::ascii;
  if (word == "binary_little_endian") return Format::little;
  if (word == "binary_big_endian") return Format::big;
  bad_ply("a PLY format, ascii, binary_little_endian or binary_big_endian", fmt::format("\"{}\"", word));
}

Property read_property(std::string_view line) {
  Property property;
  std::string_view type = take_word(line);
  if (type == "list") {
    property.count_size = size_of(take_word(line), true);
    type = take_word(line);
  }
  property.size = size_of(type, false);
  property.name = take_word(line);
  return property;
}

/// Takes the header off the bytes.
Header read_header(std::string_view& bytes) {
  if (take_line(bytes) != "ply") bad_ply("a PLY file that begins with the line \"ply\"", "another");
  Header header;
  bool format_told = false;
  while (!bytes.empty()) {
    std::string_view line = take_line(bytes);
    const std::string_view word = take_word(line);
    if (word == "end_header") {
      if (!format_told) bad_ply("a PLY header that tells the format", "none");
      return header;
    }
    if (word == "comment" || word == "obj_info") continue;
    if (word == "format") {
      header.format = format_of(take_word(line));
      format_told = true;
    } else if (word == "element") {
      const std::string_view name = take_word(line), count = take_word(line);
      const auto number = number_in<std::uint32_t>(count);
      if (!number) bad_ply("an element's count in the PLY header", fmt::format("\"{}\"", count));
      header.elements.push_back({std::string(name), *number, {}});
    } else if (word == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(read_property(line));
    } else {
      bad_ply("format, element, property, comment or end_header in the PLY header",
              fmt::format("\"{}\"", word.substr(0, 40)));
    }
  }
  bad_ply("end_header", "the file's end in its header");
}

void require_positions(const Header& header) {
  for (const std::string_view axis : {"x", "y", "z"}) {
    const auto has_axis = [&](const Element& element) {
      return element.name == "vertex" && std::any_of(element.properties.begin(), element.properties.end(),
                                                     [&](const Property& p) { return p.name == axis; });
    };
    if (std::none_of(header.elements.begin(), header.elements.end(), has_axis)) {
      bad_ply("vertices with x, y and z in the PLY header", fmt::format("no {}", axis));
    }
  }
}

void check_corners(const Element& element, const Property& property, std::uint64_t row, std::uint64_t corners) {
  const bool face = property.name == "vertex_indices" || property.name == "vertex_index";
  if (face && corners < 3) {
    bad_ply("faces of three corners or more", fmt::format("{} in {} {}", corners, element.name, row));
  }
}

void check_row_of_text(std::string_view& text, const Element& element, std::uint64_t row) {
  const auto where = [&] { return fmt::format("{} {} of {}", element.name, row, element.count); };
  if (text.empty())
    bad_ply(fmt::format("{} of {}", element.count, element.name), fmt::format("{}: a truncated file", row));
  std::string_view line = take_line(text);
  for (const Property& property : element.properties) {
    std::uint64_t values = 1;
    if (property.count_size > 0) {
      const std::string_view word = take_word(line);
      const auto count = number_in<std::uint32_t>(word);
      if (!count) bad_ply("a list's count", fmt::format("\"{}\" in {}", word, where()));
      check_corners(element, property, row, values = *count);
    }
    for (; values > 0; --values) {
      const std::string_view word = take_word(line);
      if (!number_in<double>(word)) {
        bad_ply(fmt::format("a number for {}", property.name), fmt::format("\"{}\" in {}", word, where()));
      }
    }
  }
  if (const std::string_view word = take_word(line); !word.empty()) {
    bad_ply("the line's end", fmt::format("\"{}\" in {}", word, where()));
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
      bad_ply(fmt::format("{} of {}", element.count, element.name), fmt::format("{}: a truncated file", row));
    }
    bytes.remove_prefix(size);
  };
  for (const Property& property : element.properties) {
    std::uint64_t values = 1;
    if (property.count_size > 0) {
      const std::string_view count = bytes.substr(0, property.count_size);
      take(property.count_size);
      check_corners(element, property, row, values = read_count(count, property.count_size, format));
    }
    take(values * property.size);
  }
}

}  // namespace

void check_ply(std::string_view bytes) {
  const Header header = read_header(bytes);
  require_positions(header);
  for (const Element& element : header.elements) {
    if (element.properties.empty() && element.count > 0) bad_ply("properties", fmt::format("none of {}", element.name));
    for (std::uint64_t row = 0; row < element.count; ++row) {
      if (header.format == Format::ascii)
        check_row_of_text(bytes, element, row);
      else
        check_row_of_bytes(bytes, element, row, header.format);
    }
  }
  if (bytes.find_first_not_of(" \t\r\n") != bytes.npos) {
    bad_ply("the file's end after its last element", fmt::format("{} bytes more", bytes.size()));
  }
}

}  // namespace plumbline

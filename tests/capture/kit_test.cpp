// The kit's tables of arrays and conventions are what captures and conventions files hold.
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <type_traits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "capture/capture_columns.h"
#include "capture/conventions.h"

namespace plumbline {
namespace {

// Letter of the table for the number of a group's records.
std::string count_of(Per owner) {
  switch (owner) {
    case Per::light: return "L";
    case Per::draw: return "D";
    case Per::vertex: return "V";
    case Per::clip_vertex: return "C";
    case Per::polygon: return "P";
    case Per::triangle: return "T";
    case Per::fragment: return "F";
    case Per::pixel: break;
  }
  return "";
}

// The beginning of each array's row.
struct Rows {
  std::set<std::string> rows;
  template <class Record>
  void group(Handed group, const auto& columns, const std::vector<Record>&) {
    columns.each([&]<class C>(const C& column) {
      std::vector<std::string> shape{count_of(group.per)};
      if (C::kCorners != 0) shape.push_back(std::to_string(C::kCorners));
      add(fmt::format("{}.{}", group.name, column.name), shape, Element<ColumnType<C, const Record>>(), group.stage);
    });
  }
  template <class T>
  void plane(Handed of, const Plane<T>&) {
    add(std::string(of.name), {"H", "W"}, Element<T>(), of.stage);
  }
  template <class E>
  void add(const std::string& name, std::vector<std::string> shape, E, Stage stage) {
    for (const std::size_t extent : E::extents) shape.push_back(std::to_string(extent));
    rows.insert(fmt::format("| `{}` | {} | [{}] | {} |", name, E::dtype, fmt::join(shape, ", "), name_of(stage)));
  }
};

TEST(Kit, ItsTableListsEveryArray) {
  Rows expected;
  const Capture none;
  visit_capture(expected, none);
  std::ifstream readme(PLUMBLINE_SOURCE_DIR "/src/kit/README.md");
  ASSERT_TRUE(readme);
  std::set<std::string> found;
  for (std::string line; std::getline(readme, line);) {
    std::size_t end = 0;
    for (int cell = 0; cell < 5 && end != std::string::npos; ++cell) end = line.find('|', cell == 0 ? 0 : end + 1);
    const bool is_row = line.starts_with("| `") && end != std::string::npos && end + 1 < line.size();
    if (is_row) found.insert(line.substr(0, end + 1));
  }
  for (const std::string& row : expected.rows) EXPECT_TRUE(found.contains(row)) << "lacks " << row;
  for (const std::string& row : found) {
    const bool of_capture = row.find("| [") != std::string::npos && std::ranges::any_of(kStageNames, [&](auto stage) {
                              return row.ends_with(fmt::format("| {} |", stage));
                            });
    EXPECT_TRUE(!of_capture || expected.rows.contains(row)) << "no array: " << row;
  }
}

TEST(Kit, ItsTableListsEveryConvention) {
  std::ifstream readme(PLUMBLINE_SOURCE_DIR "/src/kit/README.md");
  ASSERT_TRUE(readme);
  std::map<std::string, std::string> rows;  // by key
  for (std::string line; std::getline(readme, line);) {
    const std::size_t cell = line.find(" | ");
    if (!line.starts_with("| `") || cell == std::string::npos) continue;
    for (std::size_t at = line.find('`'); at < cell; at = line.find('`', line.find('`', at + 1) + 1))
      rows[line.substr(at + 1, line.find('`', at + 1) - at - 1)] = line.substr(cell);
  }
  each_choice([&](const ConventionWords& words, auto member) {
    using Choice = std::remove_reference_t<decltype(Conventions().*member)>;
    const std::string row = rows[std::string(words.name)];
    EXPECT_LT(row.find(fmt::format("\"{}\"", name_of(Conventions().*member))), 5u)
        << words.name << ": first its default";
    for (const Name& value : kNamesOf<Choice>)
      EXPECT_NE(row.find(fmt::format("\"{}\"", value)), std::string::npos) << words.name << " lacks " << value;
  });
  each_number_of_bits([&](const ConventionWords& words, auto member) {
    const int bits = Conventions().*member;
    const std::string first = bits == Conventions::kFloat ? "\"float\"" : std::to_string(bits);
    EXPECT_TRUE(rows[std::string(words.name)].starts_with(" | " + first)) << words.name;
  });
  for (const ConventionWords& words : {kSampleWords, kOffsetWords}) EXPECT_TRUE(rows.contains(std::string(words.name)));
}

}  // namespace
}  // namespace plumbline

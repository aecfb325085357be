// The table of scripts/mutate_comparators: each text that it replaces stands once in its file.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "mutation/fields.h"
#include "tests/text_file.h"

namespace plumbline::mutation {
namespace {

const std::filesystem::path kProject = PLUMBLINE_SOURCE_DIR;

std::size_t occurrences(const std::string& of, const std::string& in) {
  std::size_t count = 0;
  for (std::size_t at = in.find(of); at != in.npos; at = in.find(of, at + 1)) ++count;
  return count;
}

std::string with_line_ends(std::string text) {
  for (std::size_t at = 0; (at = text.find("\\n", at)) != text.npos;) text.replace(at, 2, "\n");
  return text;
}

TEST(ComparatorChanges, EachTextStandsOnceInItsFile) {
  std::ifstream table(kProject / "tests/check/mutations.tsv");
  std::size_t rows = 0, number = 0;
  for (std::string line; std::getline(table, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    ++rows;
    const std::vector<std::string> fields = fields_of(line, '\t');
    ASSERT_TRUE(fields.size() == 4 || fields.size() == 5) << "tests/check/mutations.tsv:" << number;
    EXPECT_EQ(std::ranges::count(fields, ""), 0) << "tests/check/mutations.tsv:" << number << ": bash joins two tabs";
    EXPECT_EQ(occurrences(with_line_ends(fields[1]), test::text_of(kProject / fields[0])), 1u)
        << "tests/check/mutations.tsv:" << number << ": " << fields[0] << ": " << fields[1];
    EXPECT_NE(fields[1], fields[2]) << "tests/check/mutations.tsv:" << number;
  }
  EXPECT_GT(rows, 100u);
}

TEST(ComparatorChanges, ATextIsCounted) {
  EXPECT_EQ(occurrences("aa", "baaa"), 2u);
  EXPECT_EQ(occurrences(with_line_ends("a\\nb"), "a\nb a b"), 1u);
  EXPECT_EQ(occurrences("c", "ab"), 0u);
}

}  // namespace
}  // namespace plumbline::mutation

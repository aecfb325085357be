// The names of the tests: what holds, in words that each begin with a capital, of at most 60 letters.
#include <filesystem>
#include <regex>
#include <string>

#include <gtest/gtest.h>

#include "tests/text_file.h"

namespace plumbline {
namespace {

// Names in a source of tests that are none of these.
std::string misnamed(const std::string& source) {
  static const std::regex kTest(R"((?:^|\n)(?:TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP)\(\w+,\s*(\w+))");
  static const std::regex kName("[A-Z][A-Za-z0-9]{0,59}");
  std::string out;
  for (std::sregex_iterator it(source.begin(), source.end(), kTest), end; it != end; ++it) {
    if (const std::string name = (*it)[1]; !std::regex_match(name, kName)) out += name + "\n";
  }
  return out;
}

TEST(TestNames, AreInOneStyle) {
  std::size_t files = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(PLUMBLINE_SOURCE_DIR "/tests")) {
    if (file.path().extension() != ".cpp") continue;
    EXPECT_EQ(misnamed(test::text_of(file)), "") << file.path();
    ++files;
  }
  EXPECT_GT(files, 200u);
}

TEST(TestNames, OfOtherStylesAreFound) {
  EXPECT_EQ(misnamed("\nTEST(A, IsRight) {\nTEST_P(A,\n       Ends1) {"), "");
  EXPECT_EQ(misnamed("TEST(A, is_right) {\nTEST_F(A, Is_Right) {"), "is_right\nIs_Right\n");
  EXPECT_EQ(misnamed("\nRC_GTEST_PROP(A, isRight, (int i)) {"), "isRight\n");
  const std::string longest(60, 'A');
  EXPECT_EQ(misnamed("\nTEST(A, " + longest + ") {"), "");
  EXPECT_EQ(misnamed("\nTEST(A, " + longest + "a) {"), longest + "a\n");
}

}  // namespace
}  // namespace plumbline

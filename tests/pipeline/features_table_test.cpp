// The table of features in src/pipeline/README.md names every folder of scenes, with the number of its scenes.
#include <filesystem>
#include <map>
#include <regex>

#include <gtest/gtest.h>

#include "tests/suite.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

TEST(FeaturesTable, NamesEveryFolderOfScenes) {
  const std::string readme = test::text_of(PLUMBLINE_SOURCE_DIR "/src/pipeline/README.md");
  const std::size_t from = readme.find("<!-- features:"), to = readme.find("\n\n", from);
  ASSERT_NE(from, std::string::npos);
  const std::string table = readme.substr(from, to - from);
  std::map<std::string, int> told, are;
  const std::regex folder("`([a-z_]+)` ([0-9]+)");
  for (std::sregex_iterator it(table.begin(), table.end(), folder), end; it != end; ++it) {
    EXPECT_TRUE(told.emplace((*it)[1], std::stoi((*it)[2])).second) << (*it)[1] << " twice";
  }
  for (const auto& file : suite_files()) ++are[file.parent_path().filename().string()];
  for (const char* of_all : {"notes", "models"}) are.erase(of_all);
  EXPECT_EQ(told, are);
}

}  // namespace
}  // namespace plumbline

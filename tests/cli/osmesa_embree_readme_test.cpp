// What the README shows of plumb is what plumb prints.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "run_plumb.h"

namespace plumbline {
namespace {

struct Shown {
  std::string command;
  std::vector<std::string> lines;  // "...": any number of lines
};

// The fenced blocks that begin with a command.
std::vector<Shown> shown() {
  std::ifstream in(PLUMBLINE_SOURCE_DIR "/README.md");
  std::vector<Shown> out;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      inside = false;
    } else if (line.starts_with("$ plumb ")) {
      out.push_back({line.substr(8), {}});
      inside = true;
    } else if (inside) {
      out.back().lines.push_back(line);
    }
  }
  return out;
}

TEST(Readme, ShowsWhatPlumbPrints) {
  const std::vector<Shown> blocks = shown();
  ASSERT_GE(blocks.size(), 2u);
  fs::current_path(PLUMBLINE_SOURCE_DIR);
  for (const Shown& block : blocks) {
    SCOPED_TRACE(block.command);
    std::istringstream printed(plumb(block.command).text);
    bool skips = false;
    for (const std::string& expected : block.lines) {
      if (expected == "...") {
        skips = true;
        continue;
      }
      std::string line;
      do {
        ASSERT_TRUE(std::getline(printed, line)) << "not printed: " << expected;
      } while (skips && line != expected);
      EXPECT_EQ(line, expected);
      skips = false;
    }
  }
}

}  // namespace
}  // namespace plumbline

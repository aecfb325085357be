// README files: their commands print what is shown, their links and scripts are there.
#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

struct Shown {
  std::string command;
  std::vector<std::string> lines;  // "...": any number of lines
};

// All README.md of the repository.
std::vector<fs::path> readmes() {
  const fs::path root = PLUMBLINE_SOURCE_DIR;
  std::vector<fs::path> out = {root / "README.md"};
  for (const char* folder : {"src", "reference", "golden", "tests", "scripts"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().filename() == "README.md") out.push_back(entry.path());
    }
  }
  return out;
}

// The fenced blocks that begin with a command.
std::vector<Shown> shown_in(const fs::path& readme) {
  std::ifstream in(readme);
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

void expect_printed(const Shown& block) {
  SCOPED_TRACE(block.command);
  const Outcome run = plumb(block.command);
  EXPECT_TRUE(run.code == 0 || run.code == 1) << run.text;
  EXPECT_TRUE(std::ranges::any_of(block.lines, [](const std::string& line) { return line != "..."; }));
  std::istringstream printed(run.text);
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

TEST(Readme, ShowsWhatPlumbPrints) {
  fs::current_path(PLUMBLINE_SOURCE_DIR);
  std::size_t blocks = 0;
  for (const fs::path& readme : readmes()) {
    for (const Shown& block : shown_in(readme)) {
      ++blocks;
      expect_printed(block);
    }
  }
  EXPECT_GE(blocks, 3u);
}

TEST(Readme, IsReadInFiveMinutes) {
  std::ifstream in(PLUMBLINE_SOURCE_DIR "/README.md");
  std::size_t lines = 0, words = 0;
  for (std::string line; std::getline(in, line); ++lines) {
    EXPECT_LE(line.size(), 120u) << line;
    std::istringstream text(line);
    for (std::string word; text >> word;) ++words;
  }
  EXPECT_LE(lines, 120u);
  EXPECT_LE(words, 1300u);
}

TEST(Readme, QuotesTheFaultsCode) {
  const std::string readme = test::text_of(PLUMBLINE_SOURCE_DIR "/README.md"), file = "src/faults/raster.cpp";
  const std::size_t from = readme.find('`', readme.find("`" + file + "`") + file.size() + 2) + 1;
  const std::string quoted = readme.substr(from, readme.find('`', from) - from);
  EXPECT_GT(quoted.size(), 20u);
  EXPECT_NE(test::text_of(PLUMBLINE_SOURCE_DIR "/" + file).find(quoted), std::string::npos) << quoted;
}

TEST(Readme, HoldsTheFirstSceneAndItsPicture) {
  const std::string scene = test::text_of(kScenes + "texture/first_scene.json");
  EXPECT_NE(test::text_of(PLUMBLINE_SOURCE_DIR "/README.md").find("```json\n" + scene + "```"), std::string::npos);
  const fs::path drawn = fs::temp_directory_path() / ("first_scene-" + std::to_string(::getpid()) + ".png");
  ASSERT_EQ(plumb("render " + kScenes + "texture/first_scene.json -o " + drawn.string()).code, 0);
  const Outcome same =
      plumb("compare " + drawn.string() + " " PLUMBLINE_SOURCE_DIR "/tests/walkthrough/first_scene.png");
  EXPECT_EQ(same.code, 0) << same.text;
  fs::remove(drawn);
}

// The kit's first ten minutes: the example is judged right, and the bug that the text plants is found.
class KitReadme : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    for (const char* name : {"src/kit", "tests/renderers/c", "tests/scenes/coverage"}) {
      fs::create_directories(folder_ / name);
      fs::copy(fs::path(PLUMBLINE_SOURCE_DIR) / name, folder_ / name, fs::copy_options::recursive);
    }
    const std::size_t fence = text_.find("```\n", text_.find("## The first ten minutes")) + 4;
    test::write_text(folder_ / "commands", text_.substr(fence, text_.find("```", fence) - fence));
  }
  Outcome run_commands() const {
    const std::string plumb_folder = fs::path(PLUMBLINE_PLUMB).parent_path().string();
    return shell("cd '" + folder_.string() + "' && PATH='" + plumb_folder + "':$PATH bash -e commands");
  }

  const std::string text_ = test::text_of(PLUMBLINE_SOURCE_DIR "/src/kit/README.md");
};

TEST_F(KitReadme, ItsExampleIsJudgedRight) {
  const Outcome right = run_commands();
  EXPECT_EQ(right.code, 0) << right.text;
  EXPECT_TRUE(right.says("first different stage: none")) << right.text;
}

TEST_F(KitReadme, ItsPlantedBugIsFound) {
  const fs::path file = folder_ / "tests/renderers/c/rasterizer.c";
  std::string code = test::text_of(file);
  const std::size_t line = code.find("if (e < 0"), planted = text_.find("`if (e") + 1;
  ASSERT_TRUE(line != std::string::npos && planted != 0);
  code.replace(line, code.find('\n', line) - line, text_.substr(planted, text_.find('`', planted) - planted));
  test::write_text(file, code);
  const Outcome wrong = run_commands();
  EXPECT_EQ(wrong.code, 1) << wrong.text;
  EXPECT_TRUE(wrong.says("in colour or depth: 72;") && wrong.says("likely stage: coverage")) << wrong.text;
}

// Scripts that a README names, and files that it links to.
TEST(Readme, NamesWhatIsThere) {
  const fs::path root = PLUMBLINE_SOURCE_DIR;
  std::set<std::string> scripts;
  std::vector<fs::path> texts = readmes();
  texts.push_back(root / "CONTRIBUTING.md");
  for (const fs::path& readme : texts) {
    const std::string text = test::text_of(readme);
    const std::regex script("scripts/([a-z0-9_]+)"), link("\\]\\(([^)#:]+)\\)");
    for (std::sregex_iterator it(text.begin(), text.end(), script), end; it != end; ++it) scripts.insert((*it)[1]);
    for (std::sregex_iterator it(text.begin(), text.end(), link), end; it != end; ++it) {
      EXPECT_TRUE(fs::exists(readme.parent_path() / (*it)[1].str())) << readme << ": " << (*it)[1];
    }
  }
  EXPECT_GE(scripts.size(), 10u);
  for (const std::string& name : scripts) {
    const Outcome help = shell((root / "scripts" / name).string() + " --help");
    EXPECT_EQ(help.code, 0) << name;
    EXPECT_FALSE(help.text.empty()) << name;
  }
}

}  // namespace
}  // namespace plumbline

// The kit's matcher: what its message says, and where its pages lie. Its use by an installed project: tests/install.
#include "src/kit/matches_scene.h"

#include <sstream>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

// Runs in a folder of its own, where pages are left.
struct MatcherOfScenes : Cli {
  void SetUp() override {
    Cli::SetUp();
    fs::current_path(folder_);
  }
  void TearDown() override {
    fs::current_path(before_);
    Cli::TearDown();
  }

  // The message about a frame of one black pixel, or "matches".
  static std::string said_of_black() {
    const DrawnFrame black{1, 1, {0, 0, 0, 1}, {}};
    std::ostringstream out;
    return MatchesScene(kScenes + "frame/one_pixel.json").MatchAndExplain(black, &out) ? "matches" : out.str();
  }

 private:
  fs::path before_ = fs::current_path();
};

TEST_F(MatcherOfScenes, LeavesAPageOfEachFailure) {
  const std::string page = at("plumbline_pages/MatcherOfScenes.LeavesAPageOfEachFailure/one_pixel");
  const std::string first = said_of_black();
  EXPECT_NE(first.find("page: " + page + "/index.html"), std::string::npos) << first;
  SUCCEED();  // a part of the test's result, as a failure is
  const std::string second = said_of_black();
  EXPECT_NE(second.find("page: " + page + ".1/index.html"), std::string::npos) << second;
  EXPECT_TRUE(fs::exists(page + "/index.html") && fs::exists(page + ".1/index.html"));
}

TEST_F(MatcherOfScenes, KeepsItsFindingWhereNoPageCanBeWritten) {
  test::write_text("plumbline_pages", "a file");
  const std::string said = said_of_black();
  EXPECT_NE(said.find("first different stage: "), std::string::npos) << said;
  EXPECT_NE(said.find("plumbline_pages"), std::string::npos) << said;
}

// Many faults draw nothing: none of these is the likely one.
TEST_F(MatcherOfScenes, SaysOfAnEmptyFrameThatNothingIsDrawn) {
  constexpr int kWidth = 128, kHeight = 128;
  DrawnFrame empty{kWidth, kHeight, {}, std::vector<double>(kWidth * kHeight, 1.0)};
  for (int i = 0; i < kWidth * kHeight; ++i) empty.color.insert(empty.color.end(), {0, 0, 0, 1});
  std::ostringstream out;
  EXPECT_FALSE(MatchesScene(kSharedEdges).MatchAndExplain(empty, &out));
  const std::string said = out.str();
  EXPECT_NE(said.find("\nevery pixel has the clear colour: nothing is drawn\n"), std::string::npos) << said;
  EXPECT_EQ(said.find("likely stage"), std::string::npos) << said;
}

TEST_F(MatcherOfScenes, SaysWhichSizeAFrameHas) {
  const DrawnFrame large{2, 1, {0, 0, 0, 1, 0, 0, 0, 1}, {}};
  try {
    MatchesScene(kScenes + "frame/one_pixel.json").MatchAndExplain(large, nullptr);
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("the frame: "), std::string::npos) << said;
    EXPECT_EQ(said.find("/capture"), std::string::npos) << said;
    EXPECT_NE(said.find("2 x 1"), std::string::npos) << said;
  }
}

TEST_F(MatcherOfScenes, RefusesAFrameWithoutPixels) {
  EXPECT_THROW(MatchesScene(kScenes + "frame/one_pixel.json").MatchAndExplain(DrawnFrame{}, nullptr),
               std::runtime_error);
}

}  // namespace
}  // namespace plumbline

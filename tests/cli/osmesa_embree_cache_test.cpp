// plumb check with verdicts that are kept for later runs.
#include <cstdlib>
#include <regex>
#include <thread>

#include <fmt/format.h>

#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

const std::string kThree = kScenes + "coverage/shared_edges.json " + kScenes + "clip/behind_eye.json " + kScenes +
                           "antialias/samples_gzrender.json";

std::string without_times(const Outcome& run) { return std::regex_replace(run.text, std::regex(" in [0-9.]+ s:"), ""); }

class Cache : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    ::unsetenv("PLUMBLINE_NO_CACHE");
    ::setenv("PLUMBLINE_CACHE", at("kept").c_str(), 1);
  }
  void TearDown() override {
    ::setenv("PLUMBLINE_NO_CACHE", "1", 1);
    ::unsetenv("PLUMBLINE_CACHE");
    Cli::TearDown();
  }
  std::vector<fs::path> kept() const {
    std::vector<fs::path> out;
    if (!fs::exists(folder_ / "kept")) return out;
    for (const auto& entry : fs::recursive_directory_iterator(folder_ / "kept")) {
      if (entry.is_regular_file()) out.push_back(entry.path());
    }
    return out;
  }
};

TEST_F(Cache, ChangesNoOutput) {
  const Outcome without = plumb("check --no-cache " + kThree);
  EXPECT_EQ(without.code, 0) << without.text;
  EXPECT_EQ(kept().size(), 0u);
  for (const char* jobs : {"1", "2", "1"}) {
    const Outcome with = plumb(fmt::format("check {} --jobs {}", kThree, jobs));
    EXPECT_EQ(with.code, 0);
    EXPECT_EQ(without_times(with), without_times(without));
    EXPECT_EQ(kept().size(), 3u);
  }
  for (const fs::path& file : kept()) fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_EQ(without_times(plumb("check " + kThree)), without_times(without));
}

TEST_F(Cache, IsOfOneCandidateAndItsReferences) {
  plumb("check " + kThree);
  EXPECT_EQ(plumb("check --fault coverage.inclusive_edges " + kSharedEdges).code, 1);  // not kept
  plumb("check --against exact " + kSharedEdges);
  EXPECT_EQ(kept().size(), 4u);
  plumb(fmt::format("check {} --report {}", kSharedEdges, at("page")));  // which shows what both sides drew
  EXPECT_EQ(kept().size(), 4u);
  EXPECT_EQ(plumb("check " + kThree).code, 0);
}

TEST_F(Cache, ServesRunsAtTheSameTime) {
  const std::string alone = without_times(plumb("check --no-cache " + kThree));
  std::array<Outcome, 4> runs;
  std::vector<std::thread> threads;
  for (Outcome& run : runs) threads.emplace_back([&] { run = shell(PLUMBLINE_PLUMB " check " + kThree); });
  for (std::thread& thread : threads) thread.join();
  for (const Outcome& run : runs) EXPECT_EQ(without_times(run), alone);
  EXPECT_EQ(kept().size(), 3u);
}

TEST_F(Cache, IsAFolder) {
  test::write_text(folder_ / "file", "");
  const Outcome run = plumb(fmt::format("check {} --cache {}", kSharedEdges, at("file")));
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("--cache: " + at("file") + ": expected a folder")) << run.text;
  EXPECT_EQ(plumb("check " + kSharedEdges + " --cache ''").code, 2);
}

}  // namespace
}  // namespace plumbline

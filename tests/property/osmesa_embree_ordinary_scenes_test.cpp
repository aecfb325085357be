// Ordinary scenes (ordinary/ordinary_scene.h): each is a scene file that is read and holds, in any order.
#include <cstdlib>
#include <string>
#include <vector>

#include <unistd.h>

#include "ordinary/ordinary_scene.h"
#include "tests/extent.h"
#include "tests/property/scene_trial.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kOrdinarySeeds = 20000;

// A folder of generated scene files, gone afterwards.
class OrdinaryScenes : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("plumb-ordinary-{}", getpid());
    fs::create_directories(folder_ / "ordinary");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file_of(std::uint64_t seed) const { return folder_ / "ordinary" / fmt::format("{:05}.json", seed); }
  Scene scene_of(std::uint64_t seed) const {
    test::write_text(file_of(seed), ordinary::ordinary_scene(seed));
    Scene scene = load_scene(file_of(seed), test::with_suite_images());
    fs::remove(file_of(seed));
    return scene;
  }

  fs::path folder_;
};

TEST_F(OrdinaryScenes, AreRead) {
  for (std::uint64_t seed = 1; seed <= 2000; seed += one_of(8)) {
    EXPECT_NO_THROW(scene_of(seed)) << ordinary::ordinary_scene(seed);
  }
}

// mt19937_64's numbers are the standard's, and the distributions are ours: FNV-1a of the text, on any machine.
TEST_F(OrdinaryScenes, AreTheSameForTheSameSeed) {
  const auto hash = [](const std::string& text) {
    std::uint64_t out = 0xcbf29ce484222325;
    for (const char c : text) out = (out ^ static_cast<unsigned char>(c)) * 0x100000001b3;
    return out;
  };
  std::string all;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) all += ordinary::ordinary_scene(seed);
  EXPECT_EQ(hash(all), 10614548038268845290u);
}

TEST_F(OrdinaryScenes, HoldAgainstAllReferences) {
  for (std::uint64_t seed = 1; seed <= kOrdinarySeeds; seed += one_of(133)) {
    const fs::path file = test::findings_folder() / "ordinary" / fmt::format("{:05}.json", seed);
    test::expect_holds(scene_of(seed), seed, file, ordinary::ordinary_scene(seed));
  }
}

// The rows that plumb leaves of each scene, as text, for what its arguments name.
std::vector<std::string> rows(const std::vector<fs::path>& scenes, const fs::path& into, const std::string& arguments) {
  std::string files;
  for (const fs::path& scene : scenes) files += " " + scene.string();
  const std::string command = fmt::format("{} check{} --assets {}/tests/scenes/texture --rows {} {} >/dev/null",
                                          PLUMBLINE_PLUMB, files, PLUMBLINE_SOURCE_DIR, into.string(), arguments);
  EXPECT_NE(std::system(command.c_str()), -1);  // 1 where a row fails, which is another test's matter
  std::vector<std::string> out;
  for (const fs::path& scene : scenes) {
    std::ifstream in(into / "ordinary" / scene.stem().concat(".txt"), std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text.resize(std::min(text.size(), text.find("repeat: ")));  // the command, which names the other arguments
    if (!text.empty()) out.push_back(text);
  }
  return out;
}

// What one scene leaves behind in a process (Mesa's state, memory, caches) must not reach the next.
TEST_F(OrdinaryScenes, HaveTheSameRowsInAnyOrderJobsAndShards) {
  std::vector<fs::path> scenes;
  for (std::uint64_t seed = 3; seed <= 1000; seed += 2 * one_of(20)) {
    scenes.push_back(file_of(seed));
    test::write_text(scenes.back(), ordinary::ordinary_scene(seed));
  }
  const std::vector<std::string> forward = rows(scenes, folder_ / "forward", "--jobs 1");
  ASSERT_EQ(forward.size(), scenes.size());
  EXPECT_EQ(rows(scenes, folder_ / "jobs", "--jobs 2"), forward);
  rows(scenes, folder_ / "shards", "--jobs 1 --shard 1/3");  // each a process of its own, of other scenes
  rows(scenes, folder_ / "shards", "--jobs 1 --shard 2/3");
  EXPECT_EQ(rows(scenes, folder_ / "shards", "--jobs 1 --shard 3/3"), forward);
  std::vector<std::string> backward = rows({scenes.rbegin(), scenes.rend()}, folder_ / "backward", "--jobs 1");
  EXPECT_EQ(std::vector<std::string>(backward.rbegin(), backward.rend()), forward);
}

}  // namespace
}  // namespace plumbline

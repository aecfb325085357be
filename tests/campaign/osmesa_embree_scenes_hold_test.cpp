// The campaigns' scenes of each generator: each is a scene file that is read and holds, in any order.
#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include <unistd.h>

#include "base/temporary_path.h"
#include "campaign/scene_id.h"
#include "renderers/pipeline_renderer.h"
#include "tests/campaign/scene_trial.h"
#include "tests/extent.h"
#include "tests/text_file.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using campaign::Generator;

constexpr std::uint64_t kSeeds = 20000;  // of each generator

// A folder of generated scene files, gone afterwards.
class ScenesHold : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = temporary_files() / fmt::format("plumb-scenes-{}", getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path write(const campaign::SceneId& id) const {
    const fs::path file = folder_ / (to_string(id) + ".json");
    test::write_text(file, campaign::scene_text(id));
    return file;
  }
  Scene scene_of(const campaign::SceneId& id) const {
    const fs::path file = write(id);
    Scene scene = load_scene(file, test::with_suite_images());
    fs::remove(file);
    return scene;
  }
  void expect_hold(Generator generator, std::uint64_t step) const {
    for (std::uint64_t seed = 1; seed <= kSeeds; seed += step) {
      const campaign::SceneId id{generator, {seed}};
      test::expect_holds(scene_of(id), to_string(id), campaign::scene_text(id));
    }
  }

  fs::path folder_;
};

TEST_F(ScenesHold, OrdinaryOnesAreRead) {
  for (std::uint64_t seed = 1; seed <= 2000; seed += one_of(8)) {
    EXPECT_NO_THROW(scene_of({Generator::ordinary, {seed}})) << seed;
  }
}

TEST_F(ScenesHold, OrdinaryOnesAgainstAllReferences) { expect_hold(Generator::ordinary, one_of(200)); }
TEST_F(ScenesHold, HardOnesAgainstAllReferences) { expect_hold(Generator::hard, one_of(133)); }
TEST_F(ScenesHold, PlainOnesAgainstAllReferences) { expect_hold(Generator::plain, one_of(400)); }
TEST_F(ScenesHold, FlatOnesAgainstAllReferences) { expect_hold(Generator::flat, one_of(400)); }
TEST_F(ScenesHold, InsideOnesAgainstAllReferences) { expect_hold(Generator::inside, one_of(400)); }

// Each triangle keeps its three corners, none of them made by a cut.
TEST_F(ScenesHold, InsideOnesAreCutByNoPlane) {
  Request request;
  request.records = StageSet::all();
  for (std::uint64_t seed = 1; seed <= kSeeds; seed += one_of(97)) {
    const Scene scene = scene_of({Generator::inside, {seed}});
    const ClipPolygons<double> clipped = pipeline::make_pipeline()->capture(scene, request).records.polygons;
    std::size_t primitives = 0;
    for (const DrawRange& draw : draw_ranges(scene)) primitives += draw.primitive_count;
    EXPECT_EQ(clipped.polygons.size(), primitives) << seed;
    EXPECT_TRUE(std::ranges::none_of(clipped.vertices, [](const auto& vertex) { return vertex.cut; })) << seed;
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
    const fs::path name = scene.parent_path().filename() / scene.stem().concat(".txt");
    std::string text = test::text_of(into / name);
    text.resize(std::min(text.size(), text.find("repeat: ")));  // the command, which names the other arguments
    if (!text.empty()) out.push_back(text);
  }
  return out;
}

// State that a scene leaves in a process (Mesa's, memory, caches) must not reach the next.
TEST_F(ScenesHold, WithTheSameRowsInAnyOrderJobsAndShards) {
  std::vector<fs::path> scenes;
  for (std::uint64_t seed = 3; seed <= 1000; seed += 4 * one_of(20)) {
    for (const Generator of : campaign::kGenerators) scenes.push_back(write({of, {seed}}));
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

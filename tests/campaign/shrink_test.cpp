// Scenes made smaller: what shows the finding stays, and nothing else.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "campaign/scene_id.h"
#include "campaign/shrink.h"
#include "scene/file/scene_file.h"
#include "tests/test_folder.h"
#include "tests/text_file.h"

namespace plumbline::campaign {
namespace {

using Ordered = nlohmann::ordered_json;

constexpr int kPlenty = 2000;

class Shrinking : public TestFolder {
 protected:
  // True for scenes that can be read and of which a draw `has` it.
  Shows shows(const std::function<bool(const Scene&, const Draw&)>& has) {
    return [this, has](const std::string& text) {
      ++asked_;
      test::write_text(root_ / "scene.json", text);
      try {
        const Scene scene = load_scene(root_ / "scene.json");
        return std::ranges::any_of(scene.draws, [&](const Draw& draw) { return has(scene, draw); });
      } catch (const SceneError&) {
        return false;
      }
    };
  }
  int asked_ = 0;
};

std::string hard(std::uint64_t seed) { return scene_text({Generator::hard, {seed}}); }

TEST_F(Shrinking, LeavesOneDrawOfOneTriangleAndTheStateThatMatters) {
  const Shows blends = shows([](const Scene&, const Draw& draw) { return draw.merge.blend.has_value(); });
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 40 && found < 5; ++seed) {
    if (!blends(hard(seed))) continue;
    ++found;
    const Ordered smallest = Ordered::parse(shrink(hard(seed), blends, kPlenty));
    ASSERT_EQ(smallest["draws"].size(), 1u) << smallest;
    const Ordered& draw = smallest["draws"][0];
    EXPECT_EQ(draw.size(), 2u) << draw;
    EXPECT_TRUE(draw["blend"].empty()) << draw;
    EXPECT_EQ(smallest["frame"], Ordered::parse(R"({"width": 1, "height": 1})")) << smallest;
    EXPECT_LE(draw["mesh"].dump().size(), 90u) << draw;
    for (const char* gone : {"lights", "textures", "camera", "projection", "light_model", "dialect"}) {
      EXPECT_FALSE(smallest.contains(gone)) << smallest;
    }
  }
  EXPECT_EQ(found, 5);
}

TEST_F(Shrinking, KeepsThePrimitivesThatMatter) {
  // Two triangles that share an edge, among others.
  const std::string scene = R"({"description": "Pair.", "draws": [{"mesh": {"triangles": {
    "positions": [[9.5, 0, 0], [0, 0, 0], [1.25, 0, 0], [0, 1.75, 0], [1, 1, 0], [5, 5, 5]],
    "indices": [[0, 1, 5], [1, 2, 3], [5, 4, 0], [3, 2, 4], [0, 4, 5]], "colors": [[1, 0, 0, 1], [1, 0, 0, 1],
    [1, 0, 0, 1], [1, 0, 0, 1], [1, 0, 0, 1], [1, 0, 0, 1]]}}}]})";
  const Shows pair = shows([](const Scene& scene_of, const Draw& draw) {
    const Mesh& mesh = scene_of.meshes[draw.mesh];
    bool first = false, second = false;
    for (const glm::uvec3& t : mesh.triangles) {
      const glm::vec3 a = mesh.positions[t.x], c = mesh.positions[t.z];
      first |= a == glm::vec3(0, 0, 0) && c.y > 1.5f;
      second |= a.y > 1.5f && c == glm::vec3(1, 1, 0);
    }
    return first && second;
  });
  ASSERT_TRUE(pair(scene));
  const Ordered smallest = Ordered::parse(shrink(scene, pair, kPlenty));
  EXPECT_EQ(smallest["draws"][0]["mesh"]["triangles"].dump(),
            R"({"positions":[[0,0,0],[0,0,0],[0,2,0],[1,1,0]],"indices":[[0,1,2],[2,1,3]]})");
}

TEST_F(Shrinking, GivesTheSameSceneAgain) {
  const Shows culls = shows([](const Scene&, const Draw& draw) { return draw.cull != Cull::none; });
  std::uint64_t seed = 1;
  while (!culls(hard(seed))) ++seed;
  EXPECT_EQ(shrink(hard(seed), culls, kPlenty), shrink(hard(seed), culls, kPlenty));
}

TEST_F(Shrinking, AsksNoMoreThanItMay) {
  const Shows all = shows([](const Scene&, const Draw&) { return true; });
  for (const int trials : {0, 1, 7}) {
    asked_ = 0;
    const std::string smaller = shrink(hard(1), all, trials);
    EXPECT_LE(asked_, trials);
    EXPECT_TRUE(all(smaller));
  }
}

TEST_F(Shrinking, LeavesASceneThatIsAsSmallAsCanBe) {
  const Shows none = [](const std::string&) { return false; };
  EXPECT_EQ(Ordered::parse(shrink(hard(3), none, kPlenty)), Ordered::parse(hard(3)));
}

}  // namespace
}  // namespace plumbline::campaign

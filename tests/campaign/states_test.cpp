// States of scenes, and the pairs that scenes have reached.
#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "campaign/states/reached.h"
#include "campaign/states/states.h"
#include "renderers/pipeline_renderer.h"

namespace plumbline::campaign {
namespace {

std::size_t number(const std::string& name) {
  const auto at = std::ranges::find(state_names(), name);
  EXPECT_NE(at, state_names().end()) << name;
  return static_cast<std::size_t>(at - state_names().begin());
}

Scene two_triangles() {
  Scene scene;
  scene.frame.width = scene.frame.height = 16;
  scene.meshes.resize(1);
  scene.meshes[0].positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}, {0, 0, 9}};
  scene.meshes[0].normals.assign(4, glm::vec3(0, 0, 1));
  scene.meshes[0].triangles = {{0, 1, 2}, {0, 1, 3}};
  scene.draws.resize(1);
  scene.draws[0].lit = false;
  scene.draws[0].merge.logic_op = LogicOp::xor_;
  return scene;
}
StateBits bits_of(const Scene& scene) {
  Request request;
  request.records = StageSet::all();
  return states_of(scene, pipeline::make_pipeline()->capture(scene, request));
}

TEST(SceneStates, HaveNamesOfTheirOwn) {
  const std::set<std::string> names(state_names().begin(), state_names().end());
  EXPECT_EQ(names.size(), state_names().size());
  EXPECT_GT(names.size(), 200u);
}

TEST(SceneStates, AreOfTheFormatAndOfTheStages) {
  const StateBits bits = bits_of(two_triangles());
  for (const char* is : {"dialect gl", "color rgba8", "unlit", "logic_op xor", "topology triangles", "no light",
                         "clip: a vertex behind the eye", "clip: a polygon of 3 corners", "window: a front face",
                         "a pixel without a fragment", "visibility: a fragment passes", "depth_func less"}) {
    EXPECT_TRUE(has_state(bits, number(is))) << is;
  }
  for (const char* is_not : {"dialect gzrender", "lit", "logic_op or", "several draws", "stencil: 255 is held",
                             "clip: a vertex beside the eye", "depth: at 1", "blend add", "fog exp"}) {
    EXPECT_FALSE(has_state(bits, number(is_not))) << is_not;
  }
}

TEST(SceneStates, OfWhatIsNotDrawnAreNotKnown) {
  const StateBits bits = states_of(two_triangles(), Capture());
  EXPECT_TRUE(has_state(bits, number("unlit")));
  EXPECT_FALSE(has_state(bits, number("visibility: a fragment passes")));
  EXPECT_FALSE(has_state("", number("unlit")));
}

TEST(Reached, CountsStatesAndPairsOnce) {
  Reached reached;
  EXPECT_EQ(reached.states(), 0u);
  EXPECT_EQ(reached.never().size(), state_names().size());
  const StateBits bits = bits_of(two_triangles());
  EXPECT_TRUE(reached.add(bits));
  const std::size_t states = reached.states();
  EXPECT_EQ(reached.pairs(), states * (states - 1) / 2);
  EXPECT_FALSE(reached.add(bits));
  EXPECT_FALSE(reached.add(""));
  Scene other = two_triangles();
  other.draws[0].cull = Cull::back;  // one state for another, in whose pairs it is
  other.draws[0].merge.logic_op = LogicOp::copy;
  EXPECT_TRUE(reached.add(bits_of(other)));
  EXPECT_GE(reached.states(), states + 2);
}

TEST(Reached, TakesAPairOfKnownStatesForNew) {
  Reached reached;
  StateBits first(32, '\0'), second(32, '\0'), both(32, '\0');
  first[0] = 1, second[20] = 2, both[0] = 1, both[20] = 2;
  EXPECT_TRUE(reached.add(first));
  EXPECT_TRUE(reached.add(second));
  EXPECT_EQ(reached.pairs(), 0u);
  EXPECT_TRUE(reached.add(both));
  EXPECT_EQ(reached.pairs(), 1u);
  EXPECT_FALSE(reached.add(both));
}

}  // namespace
}  // namespace plumbline::campaign

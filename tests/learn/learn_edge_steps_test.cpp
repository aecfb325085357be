// Fraction bits of edges' x, added up from row to row, that plumb learn finds.
#include <cmath>
#include <cstdint>

#include <gmock/gmock.h>

#include "tests/learn/altered_renderers.h"

namespace plumbline::learn {
namespace {

using Round = double (*)(double);

// Redraws the triangles of the probe: x of their sides, of `bits` fraction bits, is added up from row to row.
void step_edges(const Scene& scene, Capture& c, int bits, Round round) {
  if (scene.name != "probe/edge_steps") return;
  c.planes.color = {scene.frame.width, scene.frame.height, glm::vec4(0, 0, 0, 1)};
  const Mesh& mesh = scene.meshes.at(0);
  const auto one = static_cast<double>(std::int64_t{1} << bits);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 low = mesh.positions[t.x], high_x = mesh.positions[t.y], top = mesh.positions[t.z];
    const auto steps = [&](const glm::dvec3& from) {
      return static_cast<std::int64_t>(round((top.x - from.x) / (top.y - from.y) * one));
    };
    const std::int64_t of_left = steps(low), of_right = steps(high_x);
    auto left = static_cast<std::int64_t>(low.x * one) + of_left / 2,
         right = static_cast<std::int64_t>(high_x.x * one) + of_right / 2;
    for (int y = 0; y + 0.5 < top.y; ++y, left += of_left, right += of_right) {
      for (int x = 0; x < scene.frame.width; ++x) {
        const auto sample = static_cast<std::int64_t>((x + 0.5) * one);
        if (left <= sample && sample < right) c.planes.color(x, y) = glm::vec4(1);
      }
    }
  }
}

C learned_of(int bits, Round round) {
  OfAlteredScenes renderer;
  renderer.after = [=](const Scene& scene, Capture& c) { step_edges(scene, c, bits, round); };
  return learn(renderer).conventions;
}

TEST(LearnEdgeSteps, FindsTheBitsOfFixedPoint) {
  EXPECT_EQ(learned(pipeline::make_pipeline()).edge_bits, C::kFloat);
  for (const Round round : {Round(std::round), Round(std::floor), Round(std::trunc)}) {
    for (const int bits : {10, 12, 14, 16}) {
      const C found = learned_of(bits, round);
      EXPECT_EQ(found.edge_bits, bits);
      EXPECT_EQ(mistaken(found).empty(), bits >= 14) << bits;
    }
    EXPECT_EQ(learned_of(24, round).edge_bits, C::kFloat) << "too many to be seen";
  }
}

// Whole pixels are samples: the triangles' lower sides and corners lie on some.
TEST(LearnEdgeSteps, AreOfFloatsWhereCornersAreSampled) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) { scene.frame.pass.shift += 0.5; };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.sample, glm::dvec2(0));
  EXPECT_EQ(found.edge_bits, C::kFloat);
  EXPECT_FALSE(leaves_open(found, "edge_bits"));
}

// Mistakes of coverage are no fixed point, which would let them pass.
TEST(LearnEdgeSteps, AreNoFixedPointWhereCoverageIsWrong) {
  for (const faults::Fault& fault : faults::of_stages()) {
    if (!fault.name.starts_with("coverage.")) continue;
    EXPECT_EQ(learned(faulted(std::string(fault.name))).edge_bits, C::kFloat) << fault.name;
  }
}

// Sides that lie 0.008 pixel farther out in the mean: 8 samples of each triangle.
TEST(LearnEdgeSteps, AreOpenWhereSidesAreMovedAlike) {
  OfAlteredScenes renderer;
  renderer.before = [](Scene& scene) {
    if (scene.name != "probe/edge_steps") return;
    Mesh& mesh = scene.meshes.at(0);
    for (const glm::uvec3& t : mesh.triangles) mesh.positions[t.y].x += 0.016f;
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.edge_bits, C::kFloat);
  EXPECT_TRUE(leaves_open(found, "edge_bits"));
}

TEST(LearnEdgeSteps, AreOpenWhereNoNumberOfBitsExplainsTheSides) {
  OfAlteredScenes renderer;
  renderer.after = [](const Scene& scene, Capture& c) {
    if (scene.name != "probe/edge_steps") return;
    for (int y = 0; y < scene.frame.height; y += 9) {
      for (int x = 0; x < scene.frame.width; ++x) c.planes.color(x, y) = glm::vec4(0, 0, 0, 1);
    }
  };
  const C found = learn(renderer).conventions;
  EXPECT_EQ(found.edge_bits, C::kFloat);
  EXPECT_TRUE(leaves_open(found, "edge_bits"));
}

}  // namespace
}  // namespace plumbline::learn

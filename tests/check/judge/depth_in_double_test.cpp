// Renderers of others that keep depths of double in a frame that asks for float.
#include <memory>
#include <vector>

#include "check/judge/scene_case.h"
#include "tests/check/fixtures.h"

namespace plumbline::check {
namespace {

constexpr std::size_t kPixels = 16;

// Two triangles that both cover the whole of a frame of 4 x 4 pixels, the second at depth 3/4.
struct DepthInDouble : testing::Test {
  DepthInDouble() {
    scene.name = "test/depth_in_double";
    scene.frame.width = scene.frame.height = 4;
    scene.frame.depth = DepthFormat::z32f;
    scene.meshes.push_back(make_triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 1, 2}}, {}));
    scene.draws.emplace_back();
    candidate.width = candidate.height = 4;
    candidate.planes.id = {4, 4, kBackground};
    Records<double>& r = candidate.records;
    for (std::uint32_t t : {0u, 1u}) {
      r.triangles.push_back(triangle_of({glm::dvec3(0, 0, 0), {8, 0, 0}, {0, 8, 0}}, {1, 1, 1}, t));
      for (std::uint16_t y = 0; y < 4; ++y)
        for (std::uint16_t x = 0; x < 4; ++x) r.covered.push_back({.triangle = t, .x = x, .y = y});
    }
    r.depth.assign(2 * kPixels, 0.75);
    r.drawn.resize(2 * kPixels);
  }
  // Tests the depths in double by "less", and judges what is drawn.
  Comparison row(bool foreign = true) {
    for (std::size_t i = 0; i < kPixels; ++i) {
      const bool nearer = candidate.records.depth[kPixels + i] < candidate.records.depth[i];
      candidate.records.drawn[i].drawn = true;
      candidate.records.drawn[kPixels + i].drawn = nearer != (i == wrong);
      candidate.planes.id.values()[i] = candidate.records.drawn[kPixels + i].drawn ? 1 : 0;
    }
    const Legal none;
    std::vector<Comparison> out;
    Case c{scene, candidate, none, exact.get(), out};
    c.foreign = foreign;
    run_exact_stage(c, *exact, Stage::visibility, "exact");
    return out.at(0);
  }

  Scene scene;
  Capture candidate;
  std::size_t wrong = kPixels;  // number of a pixel whose test comes out wrong
  std::unique_ptr<Renderer> exact = exact::make_exact();
};

TEST_F(DepthInDouble, WhatOneFloatHoldsMayBeOrdered) {
  candidate.records.depth[0] = above(0.75);
  candidate.records.depth[5] = 0.75 + 0x1p-26;
  const Comparison c = row();
  EXPECT_EQ(c.outcome, Outcome::ambiguous_only);
  EXPECT_EQ(c.measurement.items, kPixels);
  EXPECT_EQ(c.measurement.ambiguous, 2u);
}

TEST_F(DepthInDouble, ATestThatIsWrongElsewhereIsFound) {
  candidate.records.depth[0] = above(0.75);
  wrong = 3;
  const Comparison equal_depths = row();
  EXPECT_EQ(equal_depths.outcome, Outcome::different);
  EXPECT_EQ(equal_depths.measurement.differing, 1u);
  EXPECT_EQ(equal_depths.measurement.worst.place.x, 3);
  candidate.records.depth[3] = float_above(0.75);
  EXPECT_EQ(row().measurement.differing, 1u) << "two floats";
}

TEST_F(DepthInDouble, NoOtherRendererAndNoOtherFormatIsExcused) {
  candidate.records.depth[0] = above(0.75);
  EXPECT_EQ(row(false).measurement.differing, 1u);
  scene.frame.depth = DepthFormat::z24;
  EXPECT_EQ(row().measurement.differing, 1u);
}

TEST_F(DepthInDouble, TheDepthOfTheClearedFrameCountsToo) {
  for (double& z : candidate.records.depth) z = 0.5;
  scene.frame.clear_depth = 0.75;
  candidate.records.depth[2] = 0.75 - 0x1p-27;
  EXPECT_EQ(row().outcome, Outcome::ambiguous_only);
  candidate.records.depth[2] = kNaN;
  EXPECT_EQ(row().outcome, Outcome::different);
}

}  // namespace
}  // namespace plumbline::check

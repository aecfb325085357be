// Passes and samples of antialiased scenes, and the numbers of draws: renderer and references compute them apart, and
// must agree.
#include <gtest/gtest.h>

#include <numeric>

#include "capture/stages.h"
#include "reference/arithmetic/draw_ranges.h"
#include "reference/arithmetic/passes.h"
#include "scene/antialias.h"
#include "scene/draw_index.h"

namespace plumbline {
namespace {

std::vector<Antialias> all_antialiasing() {
  std::vector<Antialias> out{{Antialias::Kind::none}, {Antialias::Kind::multisample}, {Antialias::Kind::taps}};
  for (int factor = 1; factor <= 8; ++factor) out.push_back({Antialias::Kind::supersample, factor});
  return out;
}

Scene scene_with(const Antialias& antialias) {
  Scene scene;
  scene.path = "scene.json";
  scene.frame.width = 5;
  scene.frame.height = 7;
  scene.frame.antialias = antialias;
  scene.draws.resize(2);
  scene.draws[1].scissor = Scissor{1, 2, 3, 5};
  return scene;
}

void expect_same_passes(const std::vector<Scene>& a, const std::vector<Scene>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].path, b[i].path);
    EXPECT_EQ(a[i].frame.antialias.kind, b[i].frame.antialias.kind);
    EXPECT_EQ(a[i].frame.width, b[i].frame.width);
    EXPECT_EQ(a[i].frame.height, b[i].frame.height);
    EXPECT_EQ(a[i].frame.pass.shift, b[i].frame.pass.shift);
    EXPECT_EQ(a[i].frame.pass.sample, b[i].frame.pass.sample);
    EXPECT_EQ(math::sample_offset(a[i].frame), glm::dvec2(sample_offset(b[i].frame)) / static_cast<double>(kSubpixel));
    EXPECT_FALSE(b[i].draws[0].scissor);
    const Scissor &s = *a[i].draws[1].scissor, &t = *b[i].draws[1].scissor;
    EXPECT_EQ(glm::ivec4(s.x, s.y, s.width, s.height), glm::ivec4(t.x, t.y, t.width, t.height));
  }
}

TEST(Passes, AreTheSameToRendererReferencesAndJudges) {
  for (const Antialias& antialias : all_antialiasing()) {
    const Scene scene = scene_with(antialias);
    expect_same_passes(math::pass_scenes(scene), passes_of(scene));
  }
}

TEST(Passes, ShareAPixelAlike) {
  for (const Antialias& antialias : all_antialiasing()) {
    const std::vector<math::PixelShare> theirs = math::pixel_shares(antialias, 2, 3);
    const PixelSamples mine = samples_of(antialias);
    ASSERT_EQ(theirs.size(), mine.size());
    for (std::size_t i = 0; i < theirs.size(); ++i) {
      EXPECT_EQ(theirs[i].pass, mine[i].pass);
      EXPECT_EQ(theirs[i].pixel, antialias.factor * glm::ivec2(2, 3) + mine[i].offset);
      EXPECT_EQ(theirs[i].weight, mine[i].weight);
    }
  }
}

TEST(DrawNumbers, AreTheSameToRendererAndReferences) {
  Scene scene;
  for (const std::size_t triangles : {0u, 3u, 1u, 0u, 0u, 2u, 0u}) {
    scene.draws.emplace_back().mesh = static_cast<std::uint32_t>(scene.meshes.size());
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions.resize(3 * triangles + 1);
    mesh.triangles.resize(triangles);
  }
  const std::vector<DrawRange> mine = draw_ranges(scene), theirs = math::ranges_of_draws(scene);
  const DrawIndex draws(scene);
  ASSERT_EQ(mine.size(), theirs.size());
  for (std::size_t i = 0; i < mine.size(); ++i) {
    EXPECT_EQ(mine[i].first_vertex, theirs[i].first_vertex);
    EXPECT_EQ(mine[i].vertex_count, theirs[i].vertex_count);
    EXPECT_EQ(mine[i].first_primitive, theirs[i].first_primitive);
    EXPECT_EQ(mine[i].primitive_count, theirs[i].primitive_count);
  }
  const std::size_t expected[] = {1, 1, 1, 2, 5, 5};
  for (std::uint32_t primitive = 0; primitive < 6; ++primitive) {
    EXPECT_EQ(math::draw_with(theirs, primitive), expected[primitive]);
    EXPECT_EQ(draws.of_primitive(primitive), expected[primitive]);
    EXPECT_EQ(draws.draw(primitive), &scene.draws[expected[primitive]]);
  }
  EXPECT_FALSE(draws.of_primitive(6));
  EXPECT_EQ(draws.draw(6), nullptr);
  EXPECT_EQ(draws.primitives(), 6u);
  EXPECT_EQ(draws.vertices(), 25u);
  for (std::size_t i = 0; i < mine.size(); ++i) {
    EXPECT_EQ(draws.of_vertex(mine[i].first_vertex), i);
    EXPECT_EQ(draws.of_vertex(mine[i].first_vertex + mine[i].vertex_count - 1), i);
  }
  EXPECT_FALSE(draws.of_vertex(25));
  scene.meshes[2].triangles[0] = {0, 3, 1};
  EXPECT_EQ(draws.corners(3), glm::uvec3(11, 14, 12));
  EXPECT_FALSE(math::draw_with(theirs, 6));
  EXPECT_FALSE(math::draw_with({}, 0));
}

}  // namespace
}  // namespace plumbline

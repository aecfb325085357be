// The exact reference from a scene: a chain of its own stages, and what a request takes of it.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cross/exact/records.h"

namespace plumbline {
namespace {

/// Three draws of a square: a lit one; an unlit one that crosses the first and the near plane; and a flat, unlit one
/// behind, drawn where depths are greater.
Scene crossing() {
  Scene scene;
  scene.name = "crossing";
  scene.frame.width = 48;
  scene.frame.height = 32;
  scene.frame.clear_color = {0.25f, 0.5f, 0.75f, 1};
  scene.camera = {.eye = {0, 0, 4}, .center = {0, 0, 0}, .up = {0, 1, 0}};
  scene.projection = Perspective{60, 1, 20};
  scene.lights.resize(1);
  Mesh square;
  square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  square.normals.resize(4, {0, 0, 1});
  square.colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}, {1, 1, 0, 1}};
  square.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes = {square};
  scene.draws.resize(3);
  scene.draws[0].transforms = {Rotate{20, {0, 1, 0}}};
  scene.draws[1].transforms = {Translate{{-0.8, 0, 0}}, Rotate{-80, {1, 0, 0}}, Scale{{1, 4, 1}}};
  scene.draws[1].lit = false;
  scene.draws[2].transforms = {Translate{{1, 0.2, -1}}};
  scene.draws[2].shading = Shading::flat;
  scene.draws[2].lit = false;
  scene.draws[2].depth_func = DepthFunc::greater;
  return scene;
}

const Request kEverything{.records = StageSet::all(), .legal = false, .primitives = {}, .pixels = {}};

TEST(ExactCapture, IsTheChainOfItsStages) {
  for (DepthFormat format : {DepthFormat::z8, DepthFormat::z16, DepthFormat::z24, DepthFormat::z32f}) {
    Scene scene = crossing();
    scene.frame.depth = format;
    const auto exact = exact::make_exact();
    const Capture whole = exact->capture(scene, kEverything);
    const auto alone = [&](Stage stage) { return exact->run_stage(scene, stage, whole); };
    const Records<double>& r = whole.records;

    const auto matrices = alone(Stage::matrices).records.matrices;
    ASSERT_EQ(matrices.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(matrices[i].model_view, r.matrices.at(i).model_view);
    const auto vertices = alone(Stage::vertex).records.vertices;
    ASSERT_EQ(vertices.size(), 12u);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(vertices[i].p_clip, r.vertices.at(i).p_clip);
    const auto lit = alone(Stage::light).records.lit;
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(lit.at(i).color, r.lit.at(i).color);
    const auto polygons = alone(Stage::clip).records.polygons;
    ASSERT_EQ(polygons.polygons.size(), 6u);
    ASSERT_EQ(polygons.vertices.size(), r.polygons.vertices.size());
    EXPECT_TRUE(std::any_of(polygons.vertices.begin(), polygons.vertices.end(), [](const auto& v) { return v.cut; }));
    for (std::size_t i = 0; i < polygons.vertices.size(); ++i)
      EXPECT_EQ(polygons.vertices[i].p_clip, r.polygons.vertices[i].p_clip);
    const auto triangles = alone(Stage::window).records.triangles;
    ASSERT_EQ(triangles.size(), r.triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) EXPECT_EQ(triangles[i].v[1].p_win, r.triangles[i].v[1].p_win);

    const Capture coverage = alone(Stage::coverage);
    EXPECT_EQ(coverage.planes.count.values(), whole.planes.count.values());
    EXPECT_EQ(coverage.planes.id_sum.values(), whole.planes.id_sum.values());
    ASSERT_EQ(coverage.records.covered.size(), r.covered.size());
    ASSERT_GT(r.covered.size(), 500u);
    for (std::size_t i = 0; i < r.covered.size(); ++i) {
      EXPECT_EQ(coverage.records.covered[i].triangle, r.covered[i].triangle);
      EXPECT_EQ(coverage.records.covered[i].x, r.covered[i].x);
      EXPECT_EQ(coverage.records.covered[i].y, r.covered[i].y);
    }
    EXPECT_EQ(alone(Stage::depth).records.depth, r.depth);
    const auto attributes = alone(Stage::attributes).records.attributes;
    const auto shaded = alone(Stage::shade).records.shaded;
    ASSERT_EQ(attributes.size(), r.covered.size());
    for (std::size_t i = 0; i < r.covered.size(); ++i) {
      EXPECT_EQ(attributes[i].color, r.attributes.at(i).color);
      EXPECT_EQ(shaded.at(i).color, r.shaded.at(i).color);
    }
    EXPECT_EQ(alone(Stage::visibility).planes.id.values(), whole.planes.id.values());
    const Capture merged = alone(Stage::merge);
    EXPECT_EQ(merged.planes.color.values(), whole.planes.color.values());
    EXPECT_EQ(merged.planes.depth.values(), whole.planes.depth.values());
    // Each draw is seen somewhere, and the background too: else all this says little.
    for (std::int32_t primitive : {kBackground, 0, 2, 4})
      EXPECT_NE(std::count(whole.planes.id.values().begin(), whole.planes.id.values().end(), primitive), 0)
          << primitive;
  }
}

TEST(ExactCapture, PlanesDoNotDependOnTheRecordsAskedFor) {
  const Scene scene = crossing();
  const Capture whole = exact::make_exact()->capture(scene, kEverything);
  Request few = kEverything;
  few.primitives = {3};
  few.pixels = {{20, 10}};
  for (const Request& request : {Request{}, few}) {
    const Capture c = exact::make_exact()->capture(scene, request);
    EXPECT_EQ(c.planes.count.values(), whole.planes.count.values());
    EXPECT_EQ(c.planes.id_sum.values(), whole.planes.id_sum.values());
    EXPECT_EQ(c.planes.id.values(), whole.planes.id.values());
    EXPECT_EQ(c.planes.shaded.values(), whole.planes.shaded.values());
    EXPECT_EQ(c.planes.color.values(), whole.planes.color.values());
    EXPECT_EQ(c.planes.depth.values(), whole.planes.depth.values());
  }
  const Records<double> none = exact::make_exact()->capture(scene, {}).records;
  EXPECT_TRUE(none.matrices.empty() && none.vertices.empty() && none.lit.empty() && none.polygons.vertices.empty() &&
              none.triangles.empty() && none.covered.empty() && none.depth.empty() && none.attributes.empty() &&
              none.shaded.empty());
}

TEST(ExactCapture, PrimitivesAndPixelsAreSelected) {
  const Scene scene = crossing();
  const auto exact = exact::make_exact();
  const Records<double> whole = exact->capture(scene, kEverything).records;
  Request request = kEverything;
  request.primitives = {1, 3};
  const Records<double> some = exact->capture(scene, request).records;
  ASSERT_EQ(some.polygons.polygons.size(), 2u);
  EXPECT_EQ(some.polygons.polygons[1].primitive, 3u);
  EXPECT_EQ(some.polygons.polygons[1].first, some.polygons.polygons[0].count);
  const ClipPolygon& there = whole.polygons.polygons.at(3);
  ASSERT_EQ(there.primitive, 3u);
  EXPECT_EQ(some.polygons.vertices.at(some.polygons.polygons[1].first).p_clip,
            whole.polygons.vertices.at(there.first).p_clip);

  // The fragments of those primitives, in the same order; their triangles are numbered as handed out.
  std::size_t i = 0;
  for (std::size_t f = 0; f < whole.covered.size(); ++f) {
    const auto primitive = whole.triangles[whole.covered[f].triangle].primitive;
    if (primitive != 1 && primitive != 3) continue;
    ASSERT_LT(i, some.covered.size());
    EXPECT_EQ(some.triangles.at(some.covered[i].triangle).primitive, primitive);
    EXPECT_EQ(some.depth.at(i), whole.depth[f]);
    EXPECT_EQ(some.shaded.at(i).color, whole.shaded[f].color);
    ++i;
  }
  EXPECT_EQ(i, some.covered.size());
  EXPECT_GT(i, 100u);

  const Covered& f = some.covered[some.covered.size() / 2];
  const glm::ivec2 pixel(f.x, f.y);
  request.pixels = {pixel};
  const Records<double> one = exact->capture(scene, request).records;
  ASSERT_EQ(one.covered.size(), one.depth.size());
  ASSERT_FALSE(one.covered.empty());
  for (const Covered& c : one.covered) EXPECT_EQ(glm::ivec2(c.x, c.y), pixel);
  request.pixels = {{pixel.x + scene.frame.width, pixel.y - 1}, {5, -1}, {-1, 5}, {5, 99}};  // outside the frame
  EXPECT_TRUE(exact->capture(scene, request).records.covered.empty());

  Request depth_only;
  depth_only.records = {Stage::depth};
  const Records<double> depth = exact->capture(scene, depth_only).records;
  EXPECT_EQ(depth.depth, whole.depth);
  EXPECT_TRUE(depth.covered.empty() && depth.triangles.empty());
}

TEST(ExactCapture, AWallByHand) {
  // A unit square over the left half of a 4 x 2 frame at a quarter of the depth range.
  Scene scene = crossing();
  scene.frame.width = 4;
  scene.frame.height = 2;
  scene.camera = {.eye = {0, 0, 0}, .center = {0, 0, -1}, .up = {0, 1, 0}};
  scene.projection = Orthographic{-1, 3, -1, 1, 0, 4};
  scene.draws.resize(1);
  scene.draws[0].transforms = {Translate{{0, 0, -1}}};
  scene.draws[0].lit = false;
  scene.frame.depth = DepthFormat::z16;
  const Capture c = exact::make_exact()->capture(scene, kEverything);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      const bool wall = x < 2;
      EXPECT_EQ(c.planes.count(x, y), wall ? 1u : 0u);
      EXPECT_EQ(c.planes.id(x, y), !wall ? kBackground : y > x ? 1 : 0);
      EXPECT_EQ(c.planes.depth(x, y), wall ? 16384 / 65535.0 : 1.0) << "code 16383.75 is rounded";
    }
  for (double z : c.records.depth) EXPECT_EQ(z, 0.25);
  // (0,0) lies on the diagonal between red and blue, a quarter of the way.
  EXPECT_EQ(c.planes.color(0, 0), glm::vec4(0.75f, 0, 0.25f, 1));
  EXPECT_EQ(c.planes.shaded(0, 0), glm::vec4(0.75f, 0, 0.25f, 1));
  EXPECT_EQ(c.planes.shaded(3, 0), scene.frame.clear_color);
}

TEST(ExactCapture, KeepsItsBudget) {
  Scene scene = crossing();
  Request request;
  request.memory_budget = plane_bytes(scene);
  EXPECT_NO_THROW(exact::make_exact()->capture(scene, request));
  request.memory_budget -= 1;
  EXPECT_THROW(exact::make_exact()->capture(scene, request), OverBudget);

  // One byte short of what the fragments' depths take.
  request.records = {Stage::depth};
  request.memory_budget = std::size_t{1} << 30;
  const std::size_t depths = exact::make_exact()->capture(scene, request).records.depth.size() * sizeof(double);
  request.memory_budget = plane_bytes(scene) + depths;
  EXPECT_NO_THROW(exact::make_exact()->capture(scene, request));
  request.memory_budget -= 1;
  EXPECT_THROW(exact::make_exact()->capture(scene, request), OverBudget);

  scene.frame.width = scene.frame.height = 16384;
  EXPECT_THROW(exact::make_exact()->capture(scene, {}), OverBudget);
}

TEST(ExactCapture, SaysWhatItIsAbleToShow) {
  const auto exact = exact::make_exact();
  const RendererInfo info = exact->info();
  EXPECT_EQ(info.name, "exact");
  for (std::size_t i = 0; i < kStageNames.size(); ++i) {
    const auto stage = static_cast<Stage>(i);
    EXPECT_TRUE(info[stage].shows) << kStageNames[i];
    EXPECT_TRUE(info[stage].runs) << kStageNames[i];
    EXPECT_TRUE(info[stage].reason.empty()) << kStageNames[i];
  }
  EXPECT_TRUE(exact->run_stage(crossing(), Stage::texture, {}).records.texels.empty()) << "of a scene without textures";
}

TEST(ExactCapture, AnEmptySceneIsItsBackground) {
  Scene scene = scene_of(3, 2, 0, {});
  scene.frame.clear_color = {0.1f, 0.2f, 0.3f, 0.4f};
  const Capture c = exact::make_exact()->capture(scene, kEverything);
  EXPECT_EQ(c.planes.color(2, 1), scene.frame.clear_color);
  EXPECT_EQ(c.planes.depth(2, 1), 1);
  EXPECT_EQ(c.planes.id(2, 1), kBackground);
}

}  // namespace
}  // namespace plumbline

// The prediction of how many pixels are ambiguous, on pictures whose bands are known from their sides' lengths.
#include "reference/oracle/ambiguity.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "capture/capture.h"
#include "reference/oracle/oracle.h"
#include "scene/scene.h"
#include "tests/oracle/window_answers.h"

namespace plumbline::math {
namespace {

/// White triangles in the window's coordinates, all at depth z.
Scene flat_scene(const std::vector<std::array<glm::vec2, 3>>& triangles, float z = 0.5f) {
  std::vector<std::array<glm::vec3, 3>> at_depth;
  for (const auto& [a, b, c] : triangles) at_depth.push_back({glm::vec3(a, z), {b, z}, {c, z}});
  Scene scene = window_scene(at_depth, 64);
  scene.meshes[0].colors.clear();
  return scene;
}

/// Prediction where nothing hides a side.
double predicted(const Scene& scene) {
  return ambiguous_by_edges(scene, project(scene), Plane<std::int32_t>(64, 64, kBackground));
}

/// How far the outline may be moved in the middle: nearly the same everywhere.
double delta(const Scene& scene) {
  const Projected projected = project(scene);
  return displacement(projected, projected.triangles[0], {0, 0, 1}, 1);
}

// Sides 40, 30 and 50, which no centre lies on.
constexpr std::array<glm::vec2, 3> kLower = {glm::vec2(10.25f, 10.25f), {50.25f, 10.25f}, {10.25f, 40.25f}};
constexpr std::array<glm::vec2, 3> kUpper = {glm::vec2(50.25f, 40.25f), {10.25f, 40.25f}, {50.25f, 10.25f}};

TEST(AmbiguousByEdges, IsTheAreaOfTheBandsAlongTheSides) {
  const Scene scene = flat_scene({kLower});
  const double area = 2 * delta(scene) * 120;
  EXPECT_GT(area, 0.5);
  EXPECT_NEAR(predicted(scene), area, 0.01 * area);
}

TEST(AmbiguousByEdges, CountsASideThatTwoTrianglesShareOnce) {
  const Scene scene = flat_scene({kLower, kUpper});
  const double area = 2 * delta(scene) * (40 + 30 + 40 + 30 + 50);
  EXPECT_NEAR(predicted(scene), area, 0.01 * area);
}

TEST(AmbiguousByEdges, TakesTheLargerDeltaOfTwoTrianglesThatShareASide) {
  constexpr glm::vec2 kFar(50.25f, 1e5f);
  const std::array<glm::vec2, 3> far = {kFar, kUpper[1], kUpper[2]};
  const Scene near = flat_scene({kLower}), both = flat_scene({kLower, far});
  EXPECT_GT(delta(flat_scene({far})), 2 * delta(near));
  const double without_the_side = 2 * delta(near) * (40 + 30);
  EXPECT_NEAR(predicted(both) - predicted(flat_scene({far})), without_the_side, 0.01 * without_the_side);
}

// A surface in the far plane is open wherever it covers, before or behind a winner that leaves no depth.
TEST(AmbiguousByDepth, CountsCutsOfWhatComesAfterAWinnerThatLeavesNoDepth) {
  constexpr std::array<glm::vec2, 3> kWhole = {glm::vec2(-1, -1), {200, -1}, {-1, 200}};
  Scene scene = flat_scene({kWhole}, 0.25f);
  const Scene far = flat_scene({kWhole}, std::nextafter(1.0f, 2.0f));
  scene.meshes.push_back(far.meshes[0]);
  scene.draws.push_back(far.draws[0]);
  scene.draws[1].mesh = 1;
  for (Draw& draw : scene.draws) draw.depth_range = {0, 0.5f};
  EXPECT_LT(legal_by_boxes(scene, {}).predicted_ambiguous, 64) << "the winner's depth hides it";
  scene.draws[0].merge.depth_mask = false;
  EXPECT_NEAR(legal_by_boxes(scene, {}).predicted_ambiguous, 64 * 64, 64);
}

TEST(AmbiguousByEdges, CountsWhatComesAfterAWinnerThatLeavesTheDepthAsItIs) {
  Scene scene = flat_scene({{glm::vec2(1.1f, 1.2f), {63.3f, 2.1f}, {2.2f, 59.7f}}}, 0.25f);  // nearer, drawn first
  const Scene small = flat_scene({kLower});
  scene.meshes.push_back(small.meshes[0]);
  scene.draws.push_back(small.draws[0]);
  scene.draws[1].mesh = 1;
  const Plane<std::int32_t> won(64, 64, 0);
  const double hidden = ambiguous_by_edges(scene, project(scene), won);
  scene.draws[0].merge.depth_mask = false;
  EXPECT_NEAR(ambiguous_by_edges(scene, project(scene), won), hidden + predicted(small), 0.01 * hidden);
}

TEST(AmbiguousByEdges, CountsTheCentresThatASideRunsThrough) {
  // A side of 40 along a row of centres, and two through none.
  const Scene scene = flat_scene({{glm::vec2(10.25f, 10.5f), {50.25f, 10.5f}, {10.25f, 40.3f}}});
  EXPECT_NEAR(predicted(scene), 40, 1);
}

TEST(AmbiguousByEdges, CountsASideOutsideTheWindowWhoseBandReachesIn) {
  // A triangle over the whole window, one side of which is 0.001 pixels left of it; delta is larger.
  const Scene scene = flat_scene({{glm::vec2(-0.001f, -1e5f), {1e5f, 32}, {-0.001f, 1e5f}}});
  const Projected projected = project(scene);
  const double reach = displacement(projected, projected.triangles[0], {-32, 0, 1}, 1) - 0.001;
  ASSERT_GT(reach, 0.001);
  ASSERT_LT(reach, 0.4);
  EXPECT_NEAR(predicted(scene), 64 * reach, 0.05 * 64 * reach);
}

TEST(AmbiguousByEdges, LeavesHiddenSidesOut) {
  const Scene scene = flat_scene({kLower, {glm::vec2(1, 1), {63, 2}, {2, 63}}}, 0.5f);
  Scene hidden = scene;
  for (std::size_t i = 3; i < 6; ++i) hidden.meshes[0].positions[i].z = -0.25f;  // the large one is nearer
  const double both = ambiguous_by_edges(hidden, project(hidden), Plane<std::int32_t>(64, 64, 1));
  Scene alone = hidden;
  alone.meshes[0].triangles.erase(alone.meshes[0].triangles.begin());
  EXPECT_NEAR(both, predicted(alone), 0.01 * both);
}

/// A surface at the pixel, `slope` window z per pixel.
PixelHit surface(std::uint32_t primitive, double z, double half, glm::dvec2 slope) {
  PixelHit out;
  out.hit.primitive = primitive;
  out.hit.certain = true;
  out.hit.z_lo = std::clamp(z - half, 0.0, 1.0);
  out.hit.z_hi = std::clamp(z + half, 0.0, 1.0);
  out.view = out.win = {z, half, slope};
  return out;
}

Scene with_24_bits() {
  Scene scene;
  scene.frame.depth = DepthFormat::z24;
  return scene;
}
constexpr double kStep = 1.0 / ((1 << 24) - 1);

TEST(AmbiguousByDepth, OfTwoSurfacesThatMeetIsTheirBandOverTheirSlope) {
  const Scene scene = with_24_bits();
  const PixelHit hits[] = {surface(0, 0.5, 1e-4, {0.01, 0}), surface(1, 0.505, 1e-4, {-0.01, 0})};
  const DepthShare share = ambiguous_by_depth(scene, hits, 0);
  EXPECT_NEAR(share.area, (2e-4 + kStep) / 0.02, 1e-6);
  EXPECT_FALSE(share.centre) << "the line is a quarter of a pixel away";
  const PixelHit near[] = {surface(0, 0.5, 1e-4, {0.01, 0}), surface(1, 0.5001, 1e-4, {-0.01, 0})};
  EXPECT_TRUE(ambiguous_by_depth(scene, near, 0).centre);
}

TEST(AmbiguousByDepth, IsNothingWhereTheyMeetElsewhere) {
  const Scene scene = with_24_bits();
  const PixelHit hits[] = {surface(0, 0.5, 1e-4, {0.01, 0}), surface(1, 0.521, 1e-4, {-0.01, 0})};
  EXPECT_EQ(ambiguous_by_depth(scene, hits, 0).area, 0);
  const PixelHit parallel[] = {surface(0, 0.5, 1e-4, {0.01, 0}), surface(1, 0.50021, 1e-4, {0.01, 0})};
  EXPECT_EQ(ambiguous_by_depth(scene, parallel, 0).area, 0);
}

TEST(AmbiguousByDepth, OfParallelSurfacesWithinReachIsThePixel) {
  const Scene scene = with_24_bits();
  const PixelHit hits[] = {surface(0, 0.5, 1e-4, {0.01, 0}), surface(1, 0.50019, 1e-4, {0.01, 0})};
  EXPECT_EQ(ambiguous_by_depth(scene, hits, 0).area, 1);
  EXPECT_TRUE(ambiguous_by_depth(scene, hits, 0).centre);
}

TEST(AmbiguousByDepth, OfHiddenSurfacesCountsWhereTheWinnerLeavesTheDepthAsItIs) {
  const Scene scene = with_24_bits();
  const auto share = [&](std::uint32_t winner, bool mask) {  // two that are one, and one before both
    PixelHit hits[] = {surface(0, 0.5, 1e-4, {0.01, 0}), surface(1, 0.5, 1e-4, {0.01, 0}),
                       surface(2, 0.5, 1e-4, {0.01, 0})};
    hits[winner] = surface(winner, 0.25, 1e-4, {0.02, 0});
    hits[winner].hit.depth_mask = mask;
    return ambiguous_by_depth(scene, hits, static_cast<std::int32_t>(winner)).area;
  };
  for (const std::uint32_t winner : {0u, 1u, 2u}) EXPECT_EQ(share(winner, true), 0) << winner;
  EXPECT_EQ(share(0, false), 1);
  EXPECT_EQ(share(1, false), 1) << "the last is compared with the first";
  EXPECT_EQ(share(2, false), 0) << "nothing comes after it";
}

TEST(AmbiguousByDepth, IsNothingWhereBothAreClampedToOneEnd) {
  Scene scene = with_24_bits();
  scene.depth_clamp = true;
  const auto share = [&](double a, double b) {
    const PixelHit hits[] = {surface(0, a, 1e-4, {0.01, 0}), surface(1, b, 1e-4, {0.01, 0})};
    return ambiguous_by_depth(scene, hits, 0);
  };
  for (const double beyond : {-0.25, 1.25}) {
    EXPECT_EQ(share(beyond, beyond).area, 0) << "a tie";
    EXPECT_FALSE(share(beyond, beyond).centre);
    EXPECT_EQ(share(beyond, beyond > 0 ? 1.5 : -0.5).area, 0) << "at that end too";
    EXPECT_TRUE(share(beyond, beyond > 0 ? 0.99995 : 0.00005).centre) << "one of them may not be clamped";
  }
  EXPECT_EQ(share(-0.25, 1.25).area, 0);
}

TEST(AmbiguousByDepth, OfASurfaceThatTheNearPlaneCutsIsTheBandOnBothSides) {
  const Scene scene = with_24_bits();
  const PixelHit hits[] = {surface(0, 0.005, 1e-4, {0.02, 0})};
  EXPECT_NEAR(ambiguous_by_depth(scene, hits, 0).area, 2e-4 / 0.02, 1e-9);
}

TEST(AmbiguousByDepth, OfWhatStencilValuesCountIsWhereAPlaneCutsIt) {
  const Scene scene = with_24_bits();
  const StencilFace face;
  const auto share = [&](const StencilFace* stencil, DepthFunc func, double half) {
    PixelHit hits[] = {surface(0, 0.25, 1e-6, {0, 0}), surface(1, 0.995, half, {0.02, 0})};
    for (PixelHit& h : hits) h.hit.stencil = stencil;
    hits[1].hit.depth_func = func;
    return ambiguous_by_depth(scene, hits, 0);
  };
  EXPECT_NEAR(share(&face, DepthFunc::never, 1e-4).area, 2e-4 / 0.02, 1e-9) << "it changes the stencil value";
  const double meets_cleared = (1e-4 + kStep) / 0.02;
  EXPECT_NEAR(share(&face, DepthFunc::less, 1e-4).area, 2e-4 / 0.02 + meets_cleared, 1e-6);
  for (const DepthFunc func : {DepthFunc::less, DepthFunc::never}) {
    EXPECT_TRUE(share(&face, func, 0.03).centre) << "grazing: its bound is larger than its slope";
    EXPECT_EQ(share(nullptr, func, 0.03).area, 0) << "hidden, or never drawn";
  }
}

}  // namespace
}  // namespace plumbline::math

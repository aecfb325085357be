// Lines and points of the pipeline against the exact reference, and that reference by hand.
#include <gtest/gtest.h>

#include "check/compare/compare_planes.h"
#include "check/compare/compare_records.h"
#include "check/judge/judge.h"
#include "check/judge/judge_records.h"
#include "reference/exact/barycentric.h"
#include "reference/exact/clip.h"
#include "reference/exact/coverage.h"
#include "reference/exact/exact.h"
#include "renderers/pipeline_renderer.h"
#include "tests/cross/thin_scenes.h"

namespace plumbline::test {
namespace {

// Ends anywhere, on the snapped grid, and on halves and quarters of pixels, in and around the frame.
std::vector<glm::vec3> random_ends(int lines, RandomThings& random) {
  std::vector<glm::vec3> ends;
  for (int i = 0; i < lines; ++i) {
    const int kind = random.below(4);
    const auto coordinate = [&](double low, double high) {
      const double v = static_cast<double>(random.number(low, high)), unit = kind == 1 ? 256 : kind == 2 ? 4 : 2;
      return static_cast<float>(kind == 0 ? v : std::round(v * unit) / unit);
    };
    const glm::vec3 a(coordinate(-8, 72), coordinate(-8, 72), 0);
    const double reach = random.below(2) == 0 ? 3 : 60;
    ends.push_back(a);
    ends.emplace_back(a.x + coordinate(-reach, reach), a.y + coordinate(-reach, reach), 0);
  }
  return ends;
}

// Fragments of the pipeline, which covers the same pixels as exact does from its window records.
std::size_t fragments_alike(const Scene& scene) {
  const Capture capture = pipeline::make_pipeline()->capture(
      scene, {.records = {Stage::matrices, Stage::clip, Stage::window, Stage::coverage}});
  const Capture judged = exact::make_exact()->run_stage(scene, Stage::coverage, capture);
  const check::Measurement m = check::compare_covered(capture.records, judged.records);
  EXPECT_EQ(m.differing, 0u) << to_string(m.worst.place);
  EXPECT_EQ(check::compare_coverage(capture.planes, judged.planes).differing, 0u);
  return capture.records.covered.size();
}

TEST(ExactLines, AHundredThousandRandomLinesCoverTheSamePixels) {
  RandomThings random(1);
  std::size_t fragments = 0;
  for (int i = 0; i < 50; ++i) {
    Scene scene = pixel_scene(64, 64);
    add(scene, thin_mesh(Topology::lines, random_ends(2000, random)));
    fragments += fragments_alike(scene);
  }
  EXPECT_GT(fragments, 900'000u);
}

TEST(ExactLines, WideLinesAndLargePointsCoverTheSamePixels) {
  RandomThings random(3);
  for (int i = 0; i < 40; ++i) {
    Scene scene = pixel_scene(70, 66);
    Draw& lines = add(scene, thin_mesh(Topology::lines, random_ends(60, random)));
    lines.line_width = 2 + random.below(15);
    Draw& points = add(scene, thin_mesh(Topology::points, random_ends(60, random)));
    points.point_size = 1 + random.below(64);
    points.scissor = Scissor{3, 5, 60, 50};
    fragments_alike(scene);
  }
}

TEST(ExactLines, WhatTheyCoverByHand) {
  const auto covered = [](WindowTriangle<double> t, std::uint32_t corners, std::uint32_t width) {
    t.corners = corners;
    t.width = width;
    std::vector<Covered> out;
    exact::append_covered(t, FrameFormat{}, Draw{}, 0, out);
    std::vector<glm::ivec2> pixels;
    for (const Covered& c : out) pixels.emplace_back(c.x, c.y);
    return pixels;
  };
  using Pixels = std::vector<glm::ivec2>;
  WindowTriangle<double> t{};
  t.v[0].snapped = {5 * 256, 7 * 256};
  t.v[1].snapped = t.v[2].snapped = {7 * 256, 7 * 256};
  EXPECT_EQ(covered(t, 2, 1), (Pixels{{5, 7}, {6, 7}}));
  EXPECT_EQ(covered(t, 2, 3), (Pixels{{5, 6}, {6, 6}, {5, 7}, {6, 7}, {5, 8}, {6, 8}}));
  t.v[1].snapped = t.v[2].snapped = {5 * 256, 9 * 256};
  EXPECT_EQ(covered(t, 2, 3), (Pixels{{4, 7}, {5, 7}, {6, 7}, {4, 8}, {5, 8}, {6, 8}})) << "y-major: rows";
  EXPECT_EQ(covered(t, 1, 2), (Pixels{{5, 7}, {6, 7}, {5, 8}, {6, 8}})) << "about (6, 8)";
  t.v[0].snapped -= 1;
  EXPECT_EQ(covered(t, 1, 2), (Pixels{{4, 6}, {5, 6}, {4, 7}, {5, 7}})) << "about (5, 7)";
  EXPECT_EQ(covered(t, 1, 3).front(), glm::ivec2(4, 6));
  EXPECT_EQ(covered(t, 1, 3).size(), 9u);
}

/// Triangles around the eye, many of them cut, not filled.
TEST(ExactLines, EveryStageOfRandomOutlinesHolds) {
  const auto ours = pipeline::make_pipeline();
  const auto exact = exact::make_exact();
  for (unsigned seed = 0; seed < 12; ++seed) {
    Scene scene = thin_cloud(Topology::lines, 300, seed);
    Mesh& mesh = scene.meshes[0];
    mesh.topology = Topology::triangles;
    mesh.triangles.clear();
    for (std::uint32_t i = 0; i + 2 < mesh.positions.size(); i += 3) mesh.triangles.emplace_back(i, i + 1, i + 2);
    Draw& draw = scene.draws[0];
    draw.front_mode = seed % 3 == 0 ? PolygonMode::fill : PolygonMode::line;
    draw.back_mode = seed % 2 == 0 ? PolygonMode::point : PolygonMode::line;
    draw.cull = seed % 5 == 4 ? Cull::front : Cull::none;
    draw.line_width = 1 + static_cast<int>(seed % 4);
    draw.point_size = 1 + static_cast<int>(seed);
    const Capture capture = ours->capture(scene, {.records = StageSet::all()});
    EXPECT_GT(capture.records.covered.size(), 50u);
    for (const check::Comparison& c : check::judge_records(scene, capture, *exact)) {
      EXPECT_FALSE(check::is_failure(c.outcome))
          << name_of(c.stage) << ", seed " << seed << ": " << to_string(c.measurement.worst.place) << " "
          << c.measurement.max_difference << c.note;
    }
  }
}

TEST(ExactLines, EveryStageOfRandomCloudsHolds) {
  const auto ours = pipeline::make_pipeline();
  const auto exact = exact::make_exact();
  for (const Topology topology : {Topology::lines, Topology::points}) {
    for (unsigned seed = 0; seed < 12; ++seed) {
      const Scene scene = thin_cloud(topology, 400, seed);
      const Capture capture = ours->capture(scene, {.records = StageSet::all()});
      EXPECT_GT(capture.records.covered.size(), 50u);
      for (const check::Comparison& c : check::judge_records(scene, capture, *exact)) {
        EXPECT_FALSE(check::is_failure(c.outcome))
            << name_of(c.stage) << ", seed " << seed << ": " << to_string(c.measurement.worst.place) << " "
            << c.measurement.max_difference << c.note;
      }
    }
  }
}

ClipVertex<double> vertex(glm::dvec4 p_clip, double color) { return {p_clip, glm::dvec4(color), false}; }

TEST(ExactLines, ClipCutsBothEnds) {
  const auto cut = exact::clip_line(vertex({-2, 0, 0, 1}, 0), vertex({6, 0, 0, 1}, 1));
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_EQ(cut[0].p_clip, glm::dvec4(-1, 0, 0, 1));
  EXPECT_EQ(cut[1].p_clip, glm::dvec4(1, 0, 0, 1));
  EXPECT_EQ(cut[0].color.r, 0.125);
  EXPECT_EQ(cut[1].color.r, 0.375);
  EXPECT_TRUE(cut[0].cut && cut[1].cut);
  const auto whole = exact::clip_line(vertex({-1, 0, 0, 1}, 0), vertex({0, 1, 0, 1}, 1));
  ASSERT_EQ(whole.size(), 2u);
  EXPECT_FALSE(whole[0].cut || whole[1].cut);
  EXPECT_TRUE(exact::clip_line(vertex({-3, 0, 0, 1}, 0), vertex({0, 3, 0, 1}, 1)).empty());
  EXPECT_TRUE(exact::clip_line(vertex({2, 0, 0, 1}, 0), vertex({3, 0, 0, 1}, 1)).empty());
}

TEST(ExactLines, WeightsGoByProjection) {
  WindowTriangle<double> t{};
  t.corners = 2;
  t.v[0].p_win = {2.5, 1.5, 0};
  t.v[1].p_win = t.v[2].p_win = {6.5, 3.5, 0};
  const exact::Barycentric weights(t, 16, 16);
  EXPECT_NEAR(static_cast<double>(weights.at(4, 3)[1]), 0.6, 1e-15);
  EXPECT_NEAR(static_cast<double>(weights.at(4, 3)[0]), 0.4, 1e-15);
  EXPECT_EQ(weights.at(4, 3)[2], 0);
  t.v[1].p_win = t.v[2].p_win = t.v[0].p_win;
  t.corners = 1;
  EXPECT_EQ(exact::Barycentric(t, 16, 16).at(4, 3)[0], 1);
}

TEST(ExactLines, TheOracleSaysNothingOfLines) {
  const Scene scene = thin_cloud(Topology::lines, 5, 1);
  EXPECT_TRUE(exact::make_exact()->capture(scene, {{}, true, {}, {}}).legal.empty());
}

}  // namespace
}  // namespace plumbline::test

// The pipeline behind the interface of all renderers: captures, requests, budgets, and each stage run alone.
#include "renderers/pipeline_renderer.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/capture/differing_arrays.h"
#include "tests/pipeline/boxes.h"

namespace plumbline::pipeline {
namespace {

using test::differing_planes;
using test::differing_records;
using testing::IsEmpty;
using testing_words::boxes;
using testing_words::everything;
using testing_words::kFormats;

TEST(PipelineRenderer, TheTestSceneHasWhatItIsFor) {
  const Scene scene = boxes();
  const Capture c = make_pipeline()->capture(scene, everything());
  const Records<double>& r = c.records;
  EXPECT_TRUE(std::any_of(r.polygons.polygons.begin(), r.polygons.polygons.end(), [](auto& p) { return p.count > 3; }));
  EXPECT_LT(r.polygons.polygons.size(), 66u) << "some are wholly outside";
  EXPECT_LT(r.triangles.size(), r.polygons.vertices.size() - 2 * r.polygons.polygons.size()) << "some are culled";
  const auto ranges = draw_ranges(scene);
  for (std::size_t d : {0u, 1u, 4u, 5u, 6u}) {
    EXPECT_TRUE(std::any_of(c.planes.id.values().begin(), c.planes.id.values().end(),
                            [&](std::int32_t id) {
                              return id >= static_cast<std::int32_t>(ranges[d].first_primitive) &&
                                     id < static_cast<std::int32_t>(ranges[d].first_primitive +
                                                                    ranges[d].primitive_count);
                            }))
        << "draw " << d << " is not to be seen";
  }
  EXPECT_GT(std::count(c.planes.id.values().begin(), c.planes.id.values().end(), kBackground), 100);
}

TEST(PipelineRenderer, PlanesDoNotDependOnTheRecordsAskedFor) {
  for (const auto& [color, depth] : kFormats) {
    const Scene scene = boxes(color, depth);
    const auto pipeline = make_pipeline();
    const Capture bare = pipeline->capture(scene, {});
    EXPECT_EQ(bare.renderer, "ours");
    EXPECT_FALSE(bare.version.empty());
    EXPECT_EQ(bare.width, 90);
    EXPECT_EQ(bare.height, 70);
    EXPECT_TRUE(bare.legal.empty());
    EXPECT_THAT(differing_records(bare, {}), IsEmpty());
    EXPECT_THAT(differing_planes(bare, pipeline->capture(scene, everything())), IsEmpty());
    Request few = everything();
    few.primitives = {3};
    few.pixels = {{45, 35}};
    EXPECT_THAT(differing_planes(bare, pipeline->capture(scene, few)), IsEmpty());
  }
}

TEST(PipelineRenderer, APictureIsDrawnAsItShips) {
  Request picture;
  picture.planes = WantedPlanes::picture;
  for (const auto& [color, depth] : kFormats) {
    const Scene scene = boxes(color, depth);
    const Capture drawn = make_pipeline()->capture(scene, picture);
    const Capture watched = make_pipeline()->capture(scene, {});
    EXPECT_EQ(drawn.planes.color.values(), watched.planes.color.values());
    EXPECT_EQ(drawn.planes.depth.values(), watched.planes.depth.values());
    EXPECT_TRUE(drawn.planes.count.empty()) << "nobody watched";
  }
  Request more = everything();
  more.planes = WantedPlanes::picture;
  EXPECT_FALSE(make_pipeline()->capture(boxes(), more).records.covered.empty()) << "records need watching";
}

TEST(PipelineRenderer, PlanesAreThoseOfTheFrameThatShips) {
  for (const auto& [color, depth] : kFormats) {
    const Scene scene = boxes(color, depth);
    const Capture c = make_pipeline()->capture(scene, {});
    const Frame frame = render(scene);
    for (int y = 0; y < 70; ++y) {
      for (int x = 0; x < 90; ++x) {
        if (color == ColorFormat::rgba8) {
          ASSERT_EQ(c.planes.color(x, y), glm::vec4(frame.color_rgba8(x, y)) / 255.0f);
        } else if (color != ColorFormat::rgba32f) {
          const auto largest = static_cast<float>(color_scale(color));
          ASSERT_EQ(c.planes.color(x, y), glm::vec4(frame.color_rgba16(x, y)) / largest);
        } else {
          ASSERT_EQ(c.planes.color(x, y), frame.color_rgba32f(x, y));
        }
        const double z = depth == DepthFormat::z32f ? static_cast<double>(frame.depth_z32f(x, y))
                                                    : frame.depth_code(x, y) / depth_scale(depth);
        ASSERT_EQ(c.planes.depth(x, y), z);
      }
    }
  }
}

TEST(PipelineRenderer, PlanesAreWhatTheRecordsSay) {
  const Scene scene = boxes();
  const Capture c = make_pipeline()->capture(scene, everything());
  const Records<double>& r = c.records;
  Plane<std::uint32_t> count(90, 70);
  Plane<std::uint64_t> id_sum(90, 70);
  ASSERT_EQ(r.covered.size(), r.depth.size());
  for (std::size_t i = 0; i < r.covered.size(); ++i) {
    const Covered& f = r.covered[i];
    ++count(f.x, f.y);
    const std::uint32_t primitive = r.triangles.at(f.triangle).primitive;
    id_sum(f.x, f.y) += id_weight(primitive);
    ASSERT_TRUE(i == 0 || std::tuple(r.covered[i - 1].triangle, r.covered[i - 1].y, r.covered[i - 1].x) <
                              std::tuple(f.triangle, f.y, f.x))
        << "sorted by triangle, y, x";
    if (c.planes.id(f.x, f.y) == static_cast<std::int32_t>(primitive) && r.depth[i] == c.planes.depth(f.x, f.y)) {
      ASSERT_EQ(c.planes.shaded(f.x, f.y), glm::vec4(r.shaded[i].color));
    }
  }
  EXPECT_EQ(count.values(), c.planes.count.values());
  EXPECT_EQ(id_sum.values(), c.planes.id_sum.values());
  for (int y = 0; y < 70; ++y) {
    for (int x = 0; x < 90; ++x) {
      if (c.planes.id(x, y) != kBackground) continue;
      ASSERT_EQ(c.planes.shaded(x, y), scene.frame.clear_color) << "not yet in the frame's format";
      ASSERT_EQ(c.planes.color(x, y), glm::round(scene.frame.clear_color * 255.0f) / 255.0f);
      ASSERT_EQ(c.planes.depth(x, y), 16775537 / 16777215.0);
    }
  }
}

TEST(PipelineRenderer, RequestedPrimitivesAlone) {
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  const Records<double> whole = pipeline->capture(scene, everything()).records;
  Request request = everything();
  request.primitives = {3, 12, 19, 50};
  const Records<double> some = pipeline->capture(scene, request).records;
  const auto wanted = [&](std::uint32_t p) {
    return std::find(request.primitives.begin(), request.primitives.end(), p) != request.primitives.end();
  };
  std::size_t polygons = 0;
  for (const ClipPolygon& p : whole.polygons.polygons) {
    if (!wanted(p.primitive)) continue;
    const ClipPolygon& is = some.polygons.polygons.at(polygons++);
    EXPECT_EQ(is.primitive, p.primitive);
    ASSERT_EQ(is.count, p.count);
    for (std::uint32_t i = 0; i < p.count; ++i) {
      EXPECT_EQ(some.polygons.vertices.at(is.first + i).p_clip, whole.polygons.vertices[p.first + i].p_clip);
    }
  }
  EXPECT_GT(polygons, 1u);
  EXPECT_EQ(some.polygons.polygons.size(), polygons);
  for (const auto& t : some.triangles) EXPECT_TRUE(wanted(t.primitive));
  std::size_t f = 0;
  for (std::size_t i = 0; i < whole.covered.size(); ++i) {
    if (!wanted(whole.triangles[whole.covered[i].triangle].primitive)) continue;
    ASSERT_LT(f, some.covered.size());
    EXPECT_EQ(some.covered[f].x, whole.covered[i].x);
    EXPECT_EQ(some.covered[f].y, whole.covered[i].y);
    EXPECT_EQ(some.depth.at(f), whole.depth[i]);
    EXPECT_EQ(some.attributes.at(f).color, whole.attributes[i].color);
    EXPECT_EQ(some.shaded.at(f).color, whole.shaded[i].color);
    ++f;
  }
  EXPECT_EQ(f, some.covered.size());
  EXPECT_GT(f, 50u);
}

TEST(PipelineRenderer, FragmentsOfRequestedPrimitivesNameTheTrianglesHandedOut) {
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  Request request = everything();
  request.primitives = {19, 50};
  const Capture c = pipeline->capture(scene, request);
  ASSERT_FALSE(c.records.covered.empty());
  for (const Covered& f : c.records.covered) ASSERT_LT(f.triangle, c.records.triangles.size());
  EXPECT_EQ(pipeline->run_stage(scene, Stage::depth, c).records.depth, c.records.depth);
}

TEST(PipelineRenderer, RequestedPixelsAlone) {
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  const Records<double> whole = pipeline->capture(scene, everything()).records;
  Request request = everything();
  request.pixels = {{60, 20}, {20, 40}, {200, 5}, {-1, 3}};  // in any order, outside too
  const Records<double> some = pipeline->capture(scene, request).records;
  EXPECT_EQ(some.triangles.size(), whole.triangles.size());
  std::size_t f = 0;
  for (std::size_t i = 0; i < whole.covered.size(); ++i) {
    const Covered& c = whole.covered[i];
    if (!((c.x == 60 && c.y == 20) || (c.x == 20 && c.y == 40))) continue;
    ASSERT_LT(f, some.covered.size());
    EXPECT_EQ(some.covered[f].triangle, c.triangle);
    EXPECT_EQ(some.depth.at(f), whole.depth[i]);
    ++f;
  }
  EXPECT_EQ(f, some.covered.size());
  EXPECT_GT(f, 1u);
}

TEST(PipelineRenderer, KeepsItsBudget) {
  Scene scene = boxes();
  const auto pipeline = make_pipeline();
  Request request;
  request.memory_budget = plane_bytes(scene);
  EXPECT_NO_THROW(pipeline->capture(scene, request));
  request.memory_budget -= 1;
  EXPECT_THROW(pipeline->capture(scene, request), OverBudget);
  scene.frame.width = scene.frame.height = 16384;
  EXPECT_THROW(pipeline->capture(scene, {}), OverBudget);
  try {
    pipeline->capture(scene, {});
  } catch (const OverBudget& e) {
    EXPECT_NE(std::string(e.what()).find("boxes"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("16384"), std::string::npos) << e.what();
  }
}

TEST(PipelineRenderer, RecordsCountAgainstTheBudget) {
  const Scene scene = boxes();
  const auto pipeline = make_pipeline();
  for (Stage stage : {Stage::vertex, Stage::clip, Stage::window, Stage::depth, Stage::shade}) {
    SCOPED_TRACE(name_of(stage));
    Request request;
    request.records = {stage};
    request.memory_budget = plane_bytes(scene);  // nothing is left for them
    EXPECT_THROW(pipeline->capture(scene, request), OverBudget);
  }
}

TEST(PipelineRenderer, SaysWhatItIsAbleToShow) {
  const auto pipeline = make_pipeline();
  const RendererInfo info = pipeline->info();
  EXPECT_EQ(info.name, "ours");
  EXPECT_FALSE(info.version.empty());
  EXPECT_FALSE(info.legal);
  for (std::size_t k = 0; k < kStageNames.size(); ++k) {
    const auto stage = static_cast<Stage>(k);
    EXPECT_TRUE(info[stage].shows) << kStageNames[k];
    EXPECT_TRUE(info[stage].runs) << kStageNames[k];
    EXPECT_TRUE(info[stage].reason.empty()) << kStageNames[k];
  }
  EXPECT_TRUE(pipeline->run_stage(boxes(), Stage::texture, {}).records.texels.empty()) << "of a scene without textures";
}

TEST(PipelineRenderer, AnotherStageFunctionIsUsedByCaptureAndByRunStage) {
  Stages stages = production_stages();
  stages.light = [](const LightInput& in, std::vector<Attributes>& out) {
    for (std::size_t i = 0; i < in.vertices.size(); ++i) out.push_back({{Vec4<float>(0.25f, 0.5f, 0.75f, 1)}});
  };
  const auto changed = make_pipeline(stages);
  const Scene scene = boxes();
  const Capture c = changed->capture(scene, everything());
  for (const auto& lit : c.records.lit) EXPECT_EQ(lit.color, glm::dvec4(0.25, 0.5, 0.75, 1));
  EXPECT_EQ(changed->run_stage(scene, Stage::light, c).records.lit.at(0).color, glm::dvec4(0.25, 0.5, 0.75, 1));
}

TEST(PipelineRenderer, AnEmptySceneIsItsBackground) {
  Scene scene = boxes(ColorFormat::rgba32f, DepthFormat::z32f);
  scene.draws.clear();
  const Capture c = make_pipeline()->capture(scene, everything());
  for (const auto& color : c.planes.color.values()) ASSERT_EQ(color, scene.frame.clear_color);
  for (double z : c.planes.depth.values()) ASSERT_EQ(z, static_cast<double>(0.9999f));
  EXPECT_THAT(differing_records(c, {}), IsEmpty());
}

}  // namespace
}  // namespace plumbline::pipeline

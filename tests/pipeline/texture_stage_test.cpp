// Stage 8 called alone, and what a scene without textures has of it.
#include <gtest/gtest.h>

#include <algorithm>

#include "capture/files/capture_folder.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/test_folder.h"

namespace plumbline::pipeline {
namespace {

Scene scene_of(const std::string& name) { return load_scene(PLUMBLINE_SOURCE_DIR "/tests/scenes/texture/" + name, {}); }

Request all_stages() {
  Request request;
  request.records = StageSet::all();
  return request;
}

bool same(const std::vector<Texel<double>>& a, const std::vector<Texel<double>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& p, const auto& q) { return p.color == q.color && p.lod == q.lod; });
}

TEST(PipelineTextureStage, AloneOnItsRecordsIsTheWhole) {
  const Scene scene = scene_of("two_textures.json");
  const auto pipeline = make_pipeline();
  const Capture whole = pipeline->capture(scene, all_stages());
  ASSERT_EQ(whole.records.texels.size(), whole.records.covered.size());
  EXPECT_TRUE(same(pipeline->run_stage(scene, Stage::texture, whole).records.texels, whole.records.texels));
  const Capture shaded = pipeline->run_stage(scene, Stage::shade, whole);
  EXPECT_TRUE(std::equal(shaded.records.shaded.begin(), shaded.records.shaded.end(), whole.records.shaded.begin(),
                         whole.records.shaded.end(), [](const auto& p, const auto& q) { return p.color == q.color; }));
}

TEST(PipelineTextureStage, RecordsThatDoNotFitAreRefused) {
  const Scene scene = scene_of("cube.json");
  const auto pipeline = make_pipeline();
  Capture in = pipeline->capture(scene, all_stages());
  Capture lacking = in;
  lacking.records.texels.pop_back();
  EXPECT_THROW(pipeline->run_stage(scene, Stage::shade, lacking), std::invalid_argument);
  in.records.varyings[Varying::texture].fragments.pop_back();
  EXPECT_THROW(pipeline->run_stage(scene, Stage::texture, in), std::invalid_argument);
}

TEST(PipelineTextureStage, AnUntexturedDrawsTexelIsBlackAndOpaque) {
  Scene scene = scene_of("two_textures.json");
  for (std::size_t d = 1; d < scene.draws.size(); ++d) scene.draws[d].texture.reset();
  const Capture capture = make_pipeline()->capture(scene, all_stages());
  int plain = 0;
  for (std::size_t i = 0; i < capture.records.covered.size(); ++i) {
    const std::uint32_t primitive = capture.records.triangles[capture.records.covered[i].triangle].primitive;
    if (primitive < draw_ranges(scene)[1].first_primitive) continue;
    ++plain;
    EXPECT_EQ(capture.records.texels[i].color, glm::dvec4(0, 0, 0, 1));
  }
  EXPECT_GT(plain, 0);
  scene.draws[0].texture.reset();
  EXPECT_TRUE(make_pipeline()->capture(scene, all_stages()).records.texels.empty());
}

class TexelFolder : public TestFolder {};

TEST_F(TexelFolder, KeepsThem) {
  const Capture capture = make_pipeline()->capture(scene_of("cube.json"), all_stages());
  write_capture(capture, root_ / "capture");
  const Capture back = read_capture(root_ / "capture");
  EXPECT_TRUE(same(back.records.texels, capture.records.texels));
  EXPECT_EQ(back.planes.texel.values(), capture.planes.texel.values());
}

}  // namespace
}  // namespace plumbline::pipeline

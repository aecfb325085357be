// Renderers of others that interpolate without perspective, judged by their frames.
#include <gtest/gtest.h>

#include <memory>

#include "renderers/pipeline_renderer.h"
#include "tests/check/judge/frame_verdict.h"

namespace plumbline::check {
namespace {

using C = Conventions;
using pipeline::FilteredTexel;
using test::is_right;
using test::is_wrong;

// Our renderer of scenes whose vertices lie where the window shows them: it then knows of no perspective. `texture`:
// its stage of that name.
class OfTheWindow : public Renderer {
 public:
  explicit OfTheWindow(decltype(pipeline::Stages::texture) texture) {
    pipeline::Stages stages = pipeline::production_stages();
    stages.texture = texture;
    renderer_ = pipeline::make_pipeline(stages);
  }
  RendererInfo info() const override { return renderer_->info(); }
  Capture capture(const Scene& scene, const Request& request) override {
    const Capture seen = renderer_->capture(scene, {.records = StageSet::all()});
    Scene flat = scene;
    flat.camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}};
    flat.projection = Orthographic{-1, 1, -1, 1, -1, 1};
    for (std::size_t i = 0; i < flat.meshes[0].positions.size(); ++i) {
      const glm::dvec4 p_clip(seen.records.vertices.at(i).p_clip);
      flat.meshes[0].positions[i] = glm::vec3(p_clip.x, p_clip.y, -p_clip.z) / static_cast<float>(p_clip.w);
    }
    return renderer_->capture(flat, request);
  }

 private:
  std::unique_ptr<Renderer> renderer_;
};

FilteredTexel<float> a_level_coarser(const pipeline::TextureSetup& t, const pipeline::TexCoords<float>& at,
                                     const pipeline::Gradients<float>& g) {
  return {pipeline::sample<float>(t, at, pipeline::texture<float>(t, at, g).lod + 1), 0};
}

TEST(StrangersAffine, LevelsOfDetailMayGoByWhatIsInterpolated) {
  const Scene scene = test::narrow_floor();
  C affine;
  affine.interpolation = C::Interpolation::affine;
  const auto interpolated = [&](auto texture, const C& declared) {
    return test::verdict_of(scene, std::make_unique<OfTheWindow>(texture), declared);
  };
  EXPECT_TRUE(is_right(interpolated(pipeline::production_stages().texture, affine)));
  EXPECT_TRUE(is_wrong(interpolated(pipeline::production_stages().texture, C())));
  EXPECT_TRUE(is_wrong(interpolated(a_level_coarser, affine)));
}

// The pieces of a floor that a plane cuts have attributes of their own: no colour of it is known.
TEST(StrangersAffine, NoColorOfACutFloorIsKnown) {
  C affine;
  affine.interpolation = C::Interpolation::affine;
  const auto knows_none = [](const Scene& scene, const C& declared) {
    return test::verdict_of(scene, pipeline::make_pipeline(), declared).knows_no_color;
  };
  EXPECT_TRUE(knows_none(suite_scene("texture/floor_nearest"), affine));
  EXPECT_FALSE(knows_none(suite_scene("texture/floor_nearest"), C()));
  EXPECT_FALSE(knows_none(test::narrow_floor(), affine));
  EXPECT_FALSE(knows_none(suite_scene("clip/crowd"), affine)) << "some colours are";
  Scene blended = suite_scene("texture/floor_nearest");
  const BlendTerm over{BlendFactor::source_alpha, BlendFactor::one_minus_source_alpha, BlendEquation::add};
  blended.draws[0].merge.blend = Blend{over, over, glm::vec4(0)};
  EXPECT_TRUE(knows_none(blended, affine));
  EXPECT_FALSE(knows_none(blended, C()));
}

// A floor to the horizon, of a renderer that steps: by steps beyond the frame, nearly every colour would be legal.
TEST(SteppedFloors, AreJudgedByStepsInTheFrame) {
  Conventions stepped;
  stepped.depth_arithmetic = Conventions::DepthArithmetic::in_float_stepped;
  const check::SceneVerdict verdict = test::verdict_of("texture/floor_nearest", pipeline::make_pipeline(), stepped);
  EXPECT_FALSE(verdict.knows_no_color);
  EXPECT_TRUE(test::is_right(verdict));
}

}  // namespace
}  // namespace plumbline::check

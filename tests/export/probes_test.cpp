// What pictures of single primitives tell of coverage and winners is what our pipeline shows of itself.
#include "capture/renderers/probes.h"

#include <gtest/gtest.h>

#include <limits>

#include "renderers/pipeline_renderer.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

Capture capture_of_nothing(const Scene& scene) {
  Capture out;
  out.width = scene.frame.width;
  out.height = scene.frame.height;
  return out;
}

// The planes that pictures alone come to.
Planes probed(const Scene& scene) {
  const auto renderer = pipeline::make_pipeline();
  Capture capture = capture_of_nothing(scene);
  add_probed_planes(scene, *renderer, capture);
  return capture.planes;
}

class ProbesOf : public testing::TestWithParam<const char*> {};

TEST_P(ProbesOf, AreThePlanesOfOurOwnRecords) {
  const Scene scene = suite_scene(GetParam());
  const Planes shown = pipeline::make_pipeline()->capture(scene, Request{}).planes, found = probed(scene);
  EXPECT_EQ(found.count.values(), shown.count.values());
  EXPECT_EQ(found.id_sum.values(), shown.id_sum.values());
  EXPECT_EQ(found.id.values(), shown.id.values());
}
INSTANTIATE_TEST_SUITE_P(Scenes, ProbesOf,
                         testing::Values("coverage/shared_edges", "clip/crowd", "clip/six_planes", "depth/functions",
                                         "cull/both_windings", "lines/frame_border", "points/sizes", "blend/layers",
                                         "scissor/blended", "light/flat_facets"));

TEST(Probes, TellNoWinnersWhereColoursOrStencilValuesDecide) {
  for (const char* name : {"alpha_test/cutout", "stencil/portal"}) {
    const Planes found = probed(suite_scene(name));
    EXPECT_FALSE(found.count.empty()) << name;
    EXPECT_TRUE(found.id.empty()) << name;
  }
}

// Draws no depth_func but less_equal.
struct OfLessEqual : Renderer {
  RendererInfo info() const override { return {}; }
  Capture capture(const Scene& scene, const Request& request) override {
    if (scene.draws.front().depth_func != DepthFunc::less_equal) throw Unsupported("depth_func");
    return pipeline::make_pipeline()->capture(scene, request);
  }
};

TEST(Probes, AreOfAnyFunctionThatEveryDepthPasses) {
  Scene scene = suite_scene("depth/near_and_far");
  scene.frame.clear_depth = 0.25;
  for (Draw& draw : scene.draws) draw.depth_func = DepthFunc::less_equal;
  OfLessEqual renderer;
  Capture capture = capture_of_nothing(scene);
  add_probed_planes(scene, renderer, capture);
  const Planes shown = renderer.capture(scene, Request{}).planes;
  EXPECT_EQ(capture.planes.count.values(), shown.count.values());
  EXPECT_EQ(capture.planes.id.values(), shown.id.values());
  scene.draws.front().depth_func = DepthFunc::less;
  EXPECT_THROW(add_probed_planes(scene, renderer, capture = capture_of_nothing(scene)), Unsupported);
}

// Draws no depth_func but less.
struct OfLess : Renderer {
  RendererInfo info() const override { return {}; }
  Capture capture(const Scene& scene, const Request& request) override {
    if (scene.draws.front().depth_func != DepthFunc::less) throw Unsupported("depth_func");
    return pipeline::make_pipeline()->capture(scene, request);
  }
};

TEST(Probes, AreOfLessWhereTheFarPlaneCutsAndCodesAreMany) {
  Scene scene = suite_scene("coverage/shared_edges");
  OfLess renderer;
  Capture capture = capture_of_nothing(scene);
  add_probed_planes(scene, renderer, capture);
  EXPECT_EQ(capture.planes.count.values(), renderer.capture(scene, Request{}).planes.count.values());
  scene.frame.depth = DepthFormat::z16;
  EXPECT_THROW(add_probed_planes(scene, renderer, capture = capture_of_nothing(scene)), Unsupported);
  scene.frame.depth = DepthFormat::z24;
  scene.depth_clamp = true;
  EXPECT_THROW(add_probed_planes(scene, renderer, capture = capture_of_nothing(scene)), Unsupported);
}

// Draws whole scenes, and no single primitive.
struct WholeAlone : Renderer {
  RendererInfo info() const override { return {}; }
  Capture capture(const Scene& scene, const Request& request) override {
    if (scene.meshes.front().triangles.size() == 1) throw Unsupported("no single triangles");
    return pipeline::make_pipeline()->capture(scene, request);
  }
};

TEST(Probes, ShowNoCoverageWhereOneOfThePicturesIsLacking) {
  const Scene scene = suite_scene("clip/crowd");
  WholeAlone renderer;
  Capture capture = capture_of_nothing(scene);
  EXPECT_THROW(add_probed_planes(scene, renderer, capture), Unsupported);
  EXPECT_TRUE(capture.planes.count.empty());
}

// A program with a background of its own: its pixels name primitives that the scene does not have.
class OfAnotherBackground : public Renderer {
 public:
  RendererInfo info() const override { return {}; }
  Capture capture(const Scene& scene, const Request& request) override {
    Scene other = scene;
    if (scene.meshes.front().triangles.size() > 1) other.frame.clear_color = glm::vec4(1);
    return pipeline::make_pipeline()->capture(other, request);
  }
};

TEST(Probes, ShowNoWinnersWhereAColourIsNoPrimitives) {
  const Scene scene = suite_scene("coverage/shared_edges");
  OfAnotherBackground renderer;
  Capture capture = capture_of_nothing(scene);
  EXPECT_THROW(add_probed_planes(scene, renderer, capture), Unsupported);
  EXPECT_TRUE(capture.planes.id.empty());
}

TEST(Probes, ColoursAreNumbersAndBack) {
  Scene scene;
  scene.meshes.resize(1);
  scene.meshes[0].positions.resize(3);
  scene.meshes[0].normals.resize(3);
  scene.meshes[0].triangles.assign(70000, {0, 1, 2});
  scene.draws.resize(1);
  const Mesh apart = primitives_by_color(scene).meshes[0];
  for (const int primitive : {0, 1, 253, 254, 255, 65023, 65024, 65025, 69999}) {
    EXPECT_EQ(winner_of(apart.colors[3 * static_cast<std::size_t>(primitive)]), primitive);
  }
  // Whatever a frame of codes makes of the colours.
  const Mesh up = primitives_by_color(scene, Conventions::Rounding::up).meshes[0];
  for (const std::size_t primitive : {0u, 1u, 253u, 254u, 255u, 65023u, 65024u, 65025u, 69999u}) {
    const glm::vec4 color = 255.0f * apart.colors[3 * primitive], of_up = 255.0f * up.colors[3 * primitive];
    const float less = 1 - 0x1p-22f;  // interpolated, in float
    for (const glm::vec4& codes :
         {glm::floor(color), glm::floor(less * color), glm::round(color), glm::ceil(of_up), glm::ceil(of_up / less)})
      EXPECT_EQ(winner_of(codes / 255.0f), static_cast<std::int32_t>(primitive));
  }
  EXPECT_EQ(winner_of(glm::vec4(0, 0, 0, 1)), -1);
  for (const float v : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity(), -1e30f}) {
    EXPECT_EQ(winner_of(glm::vec4(v)), -1);
  }
  EXPECT_EQ(winner_of(glm::vec4(1e30f)), 255 * 255 * 255);
  EXPECT_EQ(winner_of(glm::vec4(0, 0, 1, 1)), 255 * 255 * 255) << "a primitive's colours are below code 255";
  const auto renderer = pipeline::make_pipeline();
  Capture capture;
  EXPECT_THROW(add_probed_planes(scene, *renderer, capture), Unsupported);
}

}  // namespace
}  // namespace plumbline

// Recording changes nothing: the frame without a recorder has the colours, depths and stencil values of a capture with
// all records, bit for bit.
#include <gtest/gtest.h>

#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/cross/random_scenes.h"
#include "tests/extent.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

void expect_equal_planes(const Scene& scene) {
  const pipeline::Frame frame = pipeline::render(scene);
  constexpr std::size_t kMost = std::size_t{2} << 30;  // all records of a million triangles
  const Capture capture =
      pipeline::make_pipeline()->capture(scene, {.records = StageSet::all(), .memory_budget = kMost});
  const double scale = depth_scale(scene.frame.depth);
  const auto color_codes = static_cast<float>(color_scale(scene.frame.color));
  std::size_t differing = 0;
  for (int y = 0; y < scene.frame.height; ++y) {
    for (int x = 0; x < scene.frame.width; ++x) {
      const glm::vec4 tapped = capture.planes.color(x, y);
      const glm::vec4 shipped = !frame.color_rgba8.empty()    ? glm::vec4(frame.color_rgba8(x, y)) / 255.0f
                                : !frame.color_rgba16.empty() ? glm::vec4(frame.color_rgba16(x, y)) / color_codes
                                                              : frame.color_rgba32f(x, y);
      const double z =
          frame.depth_z32f.empty() ? frame.depth_code(x, y) / scale : static_cast<double>(frame.depth_z32f(x, y));
      const bool same_stencil = frame.stencil.empty() || frame.stencil(x, y) == capture.planes.stencil(x, y);
      if (tapped != shipped || z != capture.planes.depth(x, y) || !same_stencil) ++differing;
    }
  }
  EXPECT_EQ(differing, 0u) << scene.name;
}

TEST(Taps, PlanesAreEqualOnEveryScene) {
  const auto files = suite_files();
  for (std::size_t i = 0; i < files.size(); i += one_of(16)) expect_equal_planes(load_scene(files[i], {}));
}

TEST(Taps, PlanesAreEqualOnRandomTriangles) {
  for (const SceneKind& kind : kinds()) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) expect_equal_planes(scene_of_triangles(kind, 100, seed));
  }
}

}  // namespace
}  // namespace plumbline

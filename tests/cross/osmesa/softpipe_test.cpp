// The reference by Mesa's other driver, in a process of its own: this program makes no llvmpipe context.
#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "tests/cross/osmesa_scenes.h"

namespace plumbline::test {
namespace {

TEST(OsmesaSoftpipe, DrawsAndTellsItsName) {
  const auto softpipe = make_opengl(MesaDriver::softpipe);
  EXPECT_EQ(softpipe->info().name, "softpipe");
  EXPECT_EQ(softpipe->info().version.find("softpipe"), 0u) << softpipe->info().version;

  Scene scene = pixel_scene(8, 6);
  scene.lights.emplace_back();
  scene.light_model.ambient = glm::vec3(0.5f);
  add(scene, triangle({1, 1, 0}, {5.2f, 1, 0}, {1, 5.2f, 0}), {0.8f, 0.8f, 0.8f, 1}).lit = true;
  Request request;
  request.records = StageSet::all();
  const Capture capture = softpipe->capture(scene, request);
  EXPECT_EQ(picture(capture.planes.count, 0u), (Picture{"........",  //
                                                        ".1......",  //
                                                        ".11.....",  //
                                                        ".111....",  //
                                                        ".1111...",  //
                                                        "........"}));
  ASSERT_EQ(capture.records.lit.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(capture.records.lit[0].color[i], 0.2 * 0.5 + 0.8, 1e-6);
  EXPECT_NEAR(capture.records.lit[0].color.a, 1, 1e-6);
  ASSERT_EQ(capture.records.polygons.polygons.size(), 1u);
  ASSERT_EQ(capture.records.triangles.size(), 1u);
  EXPECT_TRUE(capture.records.triangles[0].front);
}

TEST(OsmesaSoftpipe, OneDriverPerProcess) {
  const auto softpipe = make_opengl(MesaDriver::softpipe);
  try {
    make_opengl(MesaDriver::llvmpipe);
    ADD_FAILURE() << "a second driver was given";
  } catch (const RendererFailed& failure) {
    const std::string what = failure.what();  // of the build's library, OSMesa or EGL
    EXPECT_TRUE(what.starts_with("OpenGL: this process already uses ")) << what;
    EXPECT_NE(what.find(" with softpipe; "), what.npos) << what;
    EXPECT_TRUE(what.ends_with(" with llvmpipe needs a process of its own")) << what;
  }
}

}  // namespace
}  // namespace plumbline::test

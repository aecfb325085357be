// The reference by EGL within this process, which has no other Mesa.
#include <gtest/gtest.h>

#include "reference/osmesa/osmesa.h"
#include "tests/cross/osmesa_scenes.h"

namespace plumbline::test {
namespace {

Scene one_triangle() {
  Scene scene = pixel_scene(4, 3);
  add(scene, triangle({1, 0, 0}, {4.2f, 0, 0}, {1, 3.2f, 0}), {1, 0.5f, 0, 1});
  return scene;
}
const Picture kOneTriangle = {".1..",  //
                              ".11.",  //
                              ".111"};

TEST(Egl, DrawsAndTellsItsName) {
  const auto egl = make_egl();
  EXPECT_EQ(egl->info().name, "egl");
  EXPECT_EQ(egl->info().version.find("llvmpipe"), 0u) << egl->info().version;
  Request request;
  request.records = StageSet::all();
  const Capture capture = egl->capture(one_triangle(), request);
  EXPECT_EQ(capture.renderer, "egl");
  EXPECT_EQ(picture(capture.planes.count, 0u), kOneTriangle);
  EXPECT_EQ(capture.records.vertices.size(), 3u);
  EXPECT_EQ(capture.records.lit.at(0).color, glm::dvec4(1, 0.5, 0, 1));
  EXPECT_EQ(capture.records.triangles.size(), 3u);  // two sides of the frame cut it: a pentagon
}

// One display serves all contexts; the end of one must not end the others.
TEST(Egl, ContextsComeAndGoAlone) {
  auto first = make_egl();
  auto second = make_egl();
  for (const auto* renderer : {&first, &second, &first}) {
    EXPECT_EQ(picture((*renderer)->capture(one_triangle(), {}).planes.count, 0u), kOneTriangle);
  }
  first.reset();
  EXPECT_EQ(picture(second->capture(one_triangle(), {}).planes.count, 0u), kOneTriangle);
  second.reset();
  EXPECT_EQ(picture(make_egl()->capture(one_triangle(), {}).planes.count, 0u), kOneTriangle);
}

TEST(Egl, OneDriverPerProcess) {
  const auto egl = make_egl();
  try {
    make_egl(MesaDriver::softpipe);
    ADD_FAILURE() << "a second driver was given";
  } catch (const RendererFailed& failure) {
    EXPECT_STREQ(failure.what(),
                 "OpenGL: this process already uses EGL with llvmpipe; EGL with softpipe needs a process of its own");
  }
}

}  // namespace
}  // namespace plumbline::test

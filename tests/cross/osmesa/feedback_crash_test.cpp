// Mesa's crash in feedback mode: known where it is, and no longer than it is there.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "reference/osmesa/gl/context.h"
#include "reference/osmesa/osmesa.h"
#include "reference/osmesa/readback/polygon_records.h"
#include "reference/osmesa/scene/default_state.h"
#include "reference/osmesa/scene/target.h"
#include "tests/suite.h"

namespace plumbline::osmesa {
namespace {

Scene crashing_scene() { return suite_scene("light/separate_reflection"); }

Request polygons() {
  Request request;
  request.records = {Stage::clip, Stage::window};
  return request;
}

std::string gl_version() {
  const auto context = make_opengl_context(MesaDriver::llvmpipe);
  context->make_current();
  return reinterpret_cast<const char*>(load(*context).GetString(GL_VERSION));
}

// Reads the polygons as the reference does, without asking crashes_in_feedback(). Ends the process: 0, or 1 where there
// are none.
void read_in_feedback() {
  const Scene scene = crashing_scene();
  const auto context = make_opengl_context(MesaDriver::llvmpipe);
  context->make_current();
  const Gl gl = load(*context);
  const SceneInGl in_gl(gl, scene);
  const Target target(gl, scene.frame, ColorFormat::rgba8);
  const PassState state(gl);
  target.bind();
  Records<double> records;
  read_polygons(gl, in_gl, {}, polygons(), records);
  std::_Exit(records.triangles.empty() ? 1 : 0);
}

bool ended_badly(int status) { return !WIFEXITED(status) || WEXITSTATUS(status) != 0; }

TEST(FeedbackCrash, MesaCrashesWhereItIsSaidTo) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // in a new process, without this one's threads
  const std::string version = gl_version();
  if (crashes_in_feedback(crashing_scene(), MesaDriver::llvmpipe, version)) {
    EXPECT_EXIT(read_in_feedback(), ended_badly, "")
        << version << " does not crash: bound the versions of crashes_in_feedback()";
  } else {
    EXPECT_EXIT(read_in_feedback(), testing::ExitedWithCode(0), "")
        << version << " crashes: extend the versions of crashes_in_feedback()";
  }
}

TEST(FeedbackCrash, TheReferenceSaysUnsupportedInsteadOfCrashing) {
  const auto renderer = make_opengl();
  const Scene scene = crashing_scene();
  if (crashes_in_feedback(scene, MesaDriver::llvmpipe, gl_version())) {
    EXPECT_THROW(renderer->capture(scene, polygons()), Unsupported);
  } else {
    EXPECT_FALSE(renderer->capture(scene, polygons()).records.triangles.empty());
  }
  EXPECT_FALSE(renderer->capture(scene, {}).planes.color.empty()) << "the picture needs no feedback mode";
}

TEST(FeedbackCrash, IsOfVersionsDriverAndScene) {
  constexpr const char* kBookworm = "4.5 (Compatibility Profile) Mesa 22.3.6";
  constexpr const char* kTrixie = "4.5 (Compatibility Profile) Mesa 25.0.7-2+deb13u1";
  const Scene scene = crashing_scene();
  EXPECT_FALSE(crashes_in_feedback(scene, MesaDriver::llvmpipe, kBookworm));
  EXPECT_TRUE(crashes_in_feedback(scene, MesaDriver::llvmpipe, kTrixie));
  EXPECT_FALSE(crashes_in_feedback(scene, MesaDriver::softpipe, kTrixie));
  EXPECT_FALSE(crashes_in_feedback(scene, MesaDriver::llvmpipe, "4.6.0 NVIDIA 550"));
  EXPECT_FALSE(crashes_in_feedback(scene, MesaDriver::llvmpipe, "Mesa"));
  EXPECT_TRUE(crashes_in_feedback(scene, MesaDriver::llvmpipe, "Mesa 100.1"));
  const auto spared = [&](auto change) {
    Scene changed = scene;
    change(changed);
    EXPECT_FALSE(crashes_in_feedback(changed, MesaDriver::llvmpipe, kTrixie));
  };
  spared([](Scene& s) { s.light_model.sides = LightModel::Sides::one; });
  spared([](Scene& s) { s.light_model.specular = LightModel::Specular::half_vector; });
  spared([](Scene& s) { s.lights.clear(); });
  spared([](Scene& s) {
    for (Draw& draw : s.draws) draw.shading = Shading::phong;
  });
}

}  // namespace
}  // namespace plumbline::osmesa

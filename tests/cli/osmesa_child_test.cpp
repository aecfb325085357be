// softpipe, Mesa's other driver, in a process of its own, known by its capture folder alone: a second OpenGL opinion.
#include <gtest/gtest.h>

#include "check/compare_planes.h"
#include "pipeline/pipeline_renderer.h"
#include "scene/scene_file.h"
#include "stages/process_renderer.h"

namespace plumbline {
namespace {

std::unique_ptr<Renderer> softpipe() {
  ProcessSpec spec;
  spec.name = "softpipe";
  spec.argv = {PLUMBLINE_PLUMB, "capture", "{scene}", "{folder}", "--with", "softpipe"};
  spec.shows = StageSet::all();
  return make_process_renderer(spec);
}

TEST(SoftpipeChild, agrees_with_us_but_for_ties_that_it_breaks_otherwise) {
  const auto child = softpipe();
  const auto ours = pipeline::make_pipeline();
  for (const char* name : {"clip/each_plane", "light/sphere_gouraud", "depth/interpenetrating"}) {
    const Scene scene = load_scene(std::string(PLUMBLINE_SOURCE_DIR "/tests/scenes/") + name + ".json", {});
    const Capture theirs = child->capture(scene, {StageSet::all(), false, {}, {}});
    EXPECT_EQ(theirs.renderer, "softpipe");
    const Capture mine = ours->capture(scene, {StageSet::all(), false, {}, {}});
    const check::Measurement m = check::compare_coverage(mine.planes, theirs.planes);
    EXPECT_TRUE(m.mismatch.empty()) << m.mismatch;
    EXPECT_LE(m.differing, m.items / 1000) << name;
    EXPECT_GT(theirs.records.triangles.size(), 0u);
    EXPECT_EQ(theirs.records.vertices.size(), mine.records.vertices.size());
  }
}

TEST(SoftpipeChild, a_child_that_cannot_draw_fails_with_its_words) {
  ProcessSpec spec;
  spec.name = "broken";
  spec.argv = {PLUMBLINE_PLUMB, "capture", "{scene}", "{folder}", "--with", "no-such-renderer"};
  spec.shows = StageSet::all();
  const Scene scene = load_scene(PLUMBLINE_SOURCE_DIR "/tests/scenes/cull/both_windings.json", {});
  try {
    make_process_renderer(spec)->capture(scene, {});
    FAIL() << "it must throw";
  } catch (const RendererFailed& e) {
    EXPECT_NE(std::string(e.what()).find("no-such-renderer"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace plumbline

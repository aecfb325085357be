// softpipe, Mesa's other driver, in a process of its own, known by its capture folder alone: a second OpenGL opinion.
#include <gtest/gtest.h>

#include "capture/renderers/process_renderer.h"
#include "check/compare/compare_planes.h"
#include "renderers/pipeline_renderer.h"
#include "scene/file/scene_file.h"
#include "tests/cli/run_plumb.h"

namespace plumbline {
namespace {

std::unique_ptr<Renderer> softpipe() {
  ProcessSpec spec;
  spec.name = "softpipe";
  spec.argv = {PLUMBLINE_PLUMB, "capture", "{scene}", "{output}", "--with", "softpipe"};
  spec.shows = StageSet::all();
  return make_process_renderer(spec);
}

TEST(SoftpipeChild, AgreesWithUsButForTiesThatItBreaksOtherwise) {
  const auto child = softpipe();
  const auto ours = pipeline::make_pipeline();
  for (const char* name : {"clip/each_plane", "light/sphere_gouraud", "depth/interpenetrating"}) {
    const Scene scene = suite_scene(name);
    const Capture theirs = child->capture(scene, {.records = StageSet::all()});
    EXPECT_EQ(theirs.renderer, "softpipe");
    const Capture mine = ours->capture(scene, {.records = StageSet::all()});
    const check::Measurement m = check::compare_coverage(mine.planes, theirs.planes);
    EXPECT_TRUE(m.mismatch.empty()) << m.mismatch;
    EXPECT_LE(m.differing, m.items / 1000) << name;
    EXPECT_GT(theirs.records.triangles.size(), 0u);
    EXPECT_EQ(theirs.records.vertices.size(), mine.records.vertices.size());
  }
}

TEST(SoftpipeChild, AChildThatCannotDrawFailsWithItsWords) {
  ProcessSpec spec;
  spec.name = "broken";
  spec.argv = {PLUMBLINE_PLUMB, "capture", "{scene}", "{output}", "--with", "no-such-renderer"};
  spec.shows = StageSet::all();
  const Scene scene = suite_scene("cull/both_windings");
  try {
    make_process_renderer(spec)->capture(scene, {});
    FAIL() << "it must throw";
  } catch (const RendererFailed& e) {
    EXPECT_NE(std::string(e.what()).find("no-such-renderer"), std::string::npos) << e.what();
  }
}

// The row of a reference and a stage, from the reference's name on.
std::string row_of(const std::string& table, const std::string& reference, const std::string& stage) {
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" " + reference + " ");
    if (at != line.npos && line.find(" " + stage + " ", at) != line.npos) return line.substr(at + 1);
  }
  return "";
}

const std::string kTies = kScenes + "coverage/on_centres.json";  // softpipe draws 568 of its pixels otherwise

TEST_F(Cli, SoftpipeBreaksTiesOtherwiseWhichExactSettles) {
  const Outcome run = plumb("check " + kTies + " --against softpipe,exact," + kOpenGl);
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_NE(row_of(run.text, "softpipe", "coverage").find("dispute"), std::string::npos) << run.text;
  EXPECT_NE(row_of(run.text, kOpenGl, "coverage").find("equal"), std::string::npos) << run.text;
  EXPECT_NE(row_of(run.text, "softpipe", "window").find("unsupported"), std::string::npos) << run.text;
  EXPECT_NE(row_of(run.text, "softpipe", "window").find("rounded otherwise"), std::string::npos) << run.text;
}

TEST_F(Cli, SoftpipeAloneIsSettledByExactWhichWasNotNamed) {
  const Outcome run = plumb("check " + kTies + " --against softpipe");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_NE(row_of(run.text, "softpipe", "coverage").find("dispute"), std::string::npos) << run.text;
  const std::string rows = run.text.substr(0, run.text.find("not asked: "));
  for (const char* arbiter : {" exact ", " exact, ", " embree "}) EXPECT_EQ(rows.find(arbiter), rows.npos) << run.text;
}

TEST_F(Cli, SoftpipeAloneSeesAFault) {
  const Outcome run = plumb("check " + kTies + " --against softpipe --fault coverage.inclusive_edges");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_NE(row_of(run.text, "softpipe", "coverage").find("different"), std::string::npos) << run.text;
  EXPECT_TRUE(run.says("repeat: " PLUMBLINE_PLUMB " check " + kTies + " --against softpipe --fault")) << run.text;
}

TEST_F(Cli, SoftpipeSeesAFault) {
  const Outcome run = plumb("check " + kTies + " --against softpipe,exact --fault coverage.inclusive_edges");
  EXPECT_EQ(run.code, 1) << run.text;
  EXPECT_NE(row_of(run.text, "softpipe", "coverage").find("different"), std::string::npos) << run.text;
}

// Mesa's own way adds 16-bit depth up in rounded steps.
TEST_F(Cli, SoftpipeHas16BitDepth) {
  const Outcome run =
      plumb("check " + kScenes + "depth/z16.json " + kScenes + "camera/off_centre_ortho.json --against softpipe,exact");
  EXPECT_EQ(run.code, 0) << run.text;
}

TEST_F(Cli, SoftpipeIsAskedOnlyByName) {
  const Outcome run = plumb("check " + kScenes + "cull/both_windings.json");
  EXPECT_EQ(run.code, 0) << run.text;
  EXPECT_FALSE(run.says("softpipe") || run.says(kOpenGl == "egl" ? " osmesa " : " egl ")) << run.text;
}

TEST_F(Cli, SoftpipeFindsMeshesWhereAssetsAllow) {
  fs::create_directories(folder_ / "the meshes");
  test::write_text(folder_ / "the meshes/one.obj", "v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n");
  const std::string scene = scene_file(R"({
    "description": "a mesh from another folder",
    "frame": {"width": 9, "height": 9},
    "camera": {"eye": [0, 0, 3], "center": [0, 0, 0], "up": [0, 1, 0]},
    "projection": {"perspective": {"fov_y": 60, "near": 1, "far": 10}},
    "draws": [{"mesh": {"file": "one.obj"}, "lit": false}]
  })");
  const Outcome run = plumb("check " + scene + " --against softpipe,exact --assets '" + at("the meshes") + "'");
  EXPECT_EQ(run.code, 0) << run.text;
}

}  // namespace
}  // namespace plumbline

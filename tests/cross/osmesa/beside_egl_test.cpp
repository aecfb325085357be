// OpenGL by EGL hands out what it does by OSMesa, bit for bit: either can be the reference. EGL's is in a process of
// its own, for one process holds one Mesa.
#include <cstring>

#include <gtest/gtest.h>

#include "capture/renderers/process_renderer.h"
#include "reference/osmesa/osmesa.h"
#include "scene/file/scene_file.h"
#include "tests/capture/differing_arrays.h"
#include "tests/extent.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

std::unique_ptr<Renderer> egl() {
  ProcessSpec spec;
  spec.name = "egl";
  spec.argv = {PLUMBLINE_PLUMB, "capture", "{scene}", "{output}", "--with", "egl"};
  spec.shows = StageSet::all();
  return make_process_renderer(spec);
}

// One of `every` scenes.
void compare_on(const std::vector<std::filesystem::path>& folders, std::size_t every = 1) {
  const auto osmesa = make_osmesa();
  const auto other = egl();
  const Request all{.records = StageSet::all()};
  const auto files = find_scenes(folders);
  for (std::size_t i = 0; i < files.size(); i += every) {
    const auto& file = files[i];
    SCOPED_TRACE(file);
    const Scene scene = load_scene(file, {});
    if (antialiased(scene)) {  // its passes stand in no file
      EXPECT_THROW(other->capture(scene, all), Unsupported);
      continue;
    }
    Capture mine;
    try {
      mine = osmesa->capture(scene, all);
    } catch (const Unsupported&) {
      EXPECT_ANY_THROW(other->capture(scene, all));
      continue;
    }
    test::expect_same_captures(mine, other->capture(scene, all));
  }
}

TEST(OsmesaEgl, SameBitsOnAFewScenes) {
  const std::filesystem::path suite = suite_folder();
  compare_on({suite / "clip/each_plane.json", suite / "depth/z16.json", suite / "light/sphere_gouraud.json"});
}

// A process for each.
TEST(OsmesaEgl, SameBitsOnScenesOfAllKinds) { compare_on({suite_folder()}, one_of(100)); }

// Beside each other, each would draw into the other's current context without a word.
TEST(OsmesaEgl, OneLibraryPerProcess) {
  const auto osmesa = make_osmesa();
  try {
    make_egl();
    ADD_FAILURE() << "a second library was given";
  } catch (const RendererFailed& failure) {
    EXPECT_STREQ(
        failure.what(),
        "OpenGL: this process already uses OSMesa with llvmpipe; EGL with llvmpipe needs a process of its own");
  }
}

// The comparison can fail: the same scene with one triangle less.
TEST(OsmesaEgl, OtherBitsAreSeen) {
  Scene scene = suite_scene("clip/each_plane");
  const Request all{.records = StageSet::all()};
  const Capture whole = egl()->capture(scene, all);
  EXPECT_EQ(whole.renderer, "egl");
  EXPECT_EQ(whole.version.find("llvmpipe"), 0u) << whole.version;
  scene.meshes.at(0).triangles.pop_back();
  const Capture less = make_osmesa()->capture(scene, all);
  EXPECT_NE(std::memcmp(whole.planes.count.values().data(), less.planes.count.values().data(),
                        whole.planes.count.size() * sizeof(std::uint32_t)),
            0);
}

}  // namespace
}  // namespace plumbline

// Watching changes nothing: on every scene of the suite the planes are the same bits with and without records.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "pipeline/render.h"
#include "renderers/pipeline_renderer.h"
#include "scene/antialias.h"
#include "scene/file/scene_file.h"
#include "tests/extent.h"
#include "tests/suite.h"

namespace plumbline {
namespace {

template <class T>
bool same_bits(const Plane<T>& a, const Plane<T>& b) {
  return a.width() == b.width() && a.height() == b.height() &&
         (a.empty() || std::memcmp(a.values().data(), b.values().data(), a.size() * sizeof(T)) == 0);
}

TEST(EveryScene, HasTheSamePlanesWatchedOrNot) {
  const auto pipeline = pipeline::make_pipeline();
  int watched = 0, with_stencil = 0, too_large = 0;
  const auto files = suite_files();
  for (std::size_t i = 0; i < files.size(); i += one_of(8)) {
    const auto& file = files[i];
    const Scene scene = load_scene(file, {});
    for (const Scene& pass : passes_of(scene)) {
      Request picture, all;
      picture.planes = WantedPlanes::picture;
      all.records = StageSet::all();
      const Capture drawn = pipeline->capture(pass, picture);
      try {
        const Capture seen = pipeline->capture(pass, all);
        ++watched;
        EXPECT_TRUE(same_bits(seen.planes.color, drawn.planes.color)) << scene.name;
        EXPECT_TRUE(same_bits(seen.planes.depth, drawn.planes.depth)) << scene.name;
        if (pass.frame.stencil != StencilFormat::none) {
          ++with_stencil;
          EXPECT_TRUE(same_bits(seen.planes.stencil, pipeline::render(pass).stencil)) << scene.name;
        }
        EXPECT_FALSE(seen.records.triangles.empty() &&
                     std::ranges::any_of(seen.planes.count.values(), [](auto n) { return n != 0; }))
            << scene.name << ": fragments of no triangle";
      } catch (const OverBudget&) {
        ++too_large;
      }
    }
  }
  EXPECT_GT(watched, 380 / static_cast<int>(one_of(8)));
  EXPECT_GT(with_stencil, 7 / static_cast<int>(one_of(8)));
  EXPECT_LE(too_large, 1) << "the million triangles";
}

}  // namespace
}  // namespace plumbline

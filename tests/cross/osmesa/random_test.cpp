// Random triangles of every kind against OSMesa, end to end from the scene: every stage within its bounds, and the same
// coverage counts, bit for bit, but for disputes where faces are culled.
#include <gtest/gtest.h>

#include "check/judge/judge.h"
#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"
#include "renderers/pipeline_renderer.h"
#include "tests/cross/random_scenes.h"
#include "tests/extent.h"

namespace plumbline {
namespace {

TEST(OsmesaRandom, CoverageIsTheSameAndValuesWithinTheirBounds) {
  const auto ours = pipeline::make_pipeline();
  const auto osmesa = make_opengl();
  const auto exact = exact::make_exact();
  const check::Reference references[] = {{"osmesa", osmesa.get()}, {"exact", exact.get()}};
  for (const SceneKind& kind : kinds()) {
    for (std::uint64_t seed = 0; seed < 14 / one_of(7); ++seed) {
      const Scene scene = scene_of_triangles(kind, 200, seed);
      for (const check::Comparison& c : check::judge(scene, *ours, references).comparisons) {
        if (c.judge.reference != "osmesa") continue;
        EXPECT_FALSE(check::is_failure(c.outcome))
            << scene.name << ": " << name_of(c.stage) << ": " << c.measurement.differing << " of "
            << c.measurement.items << " differ, worst " << to_string(c.measurement.worst.place) << ": "
            << c.measurement.worst.difference << " " << c.measurement.unit << ", tolerance "
            << c.measurement.worst.tolerance << " " << c.note;
        if (c.stage != Stage::coverage) continue;
        // A dispute: OSMesa culls by unsnapped areas where it clips.
        const bool may_dispute = scene.draws[0].cull != Cull::none;
        EXPECT_TRUE(c.outcome == check::Outcome::equal || (may_dispute && c.outcome == check::Outcome::dispute))
            << scene.name << ": " << name_of(c.outcome);
      }
    }
  }
}

}  // namespace
}  // namespace plumbline

// Scenes of finite coordinates of any size, beyond what a scene file may hold: the stages' products overflow.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/campaign/scene_trial.h"
#include "tests/property/random_scene.h"

namespace plumbline {
namespace {

bool finite(const glm::vec4& v) { return std::isfinite(v.x + v.y + v.z + v.w); }

RC_GTEST_PROP(AnyNumbers, LeaveNoNaN, ()) {
  const Scene scene = test::random_scene(test::any_float());
  for (const auto& renderer : {pipeline::make_pipeline(), exact::make_exact()}) {
    const Capture drawn = renderer->capture(scene, {});
    for (const glm::vec4& c : drawn.planes.color.values()) RC_ASSERT(finite(c));
    for (double z : drawn.planes.depth.values()) RC_ASSERT(z >= 0 && z <= 1);
  }
}

// The references may decline such scenes; none may crash or hang.
RC_GTEST_PROP(AnyNumbers, AreJudged, ()) {
  const Scene scene = test::random_scene(test::any_float());
  for (const check::Comparison& c : test::judge_by_all(scene).comparisons) {
    if (c.outcome == check::Outcome::failed) RC_FAIL(title_of(c.judge) + ": " + c.note);
  }
}

}  // namespace
}  // namespace plumbline

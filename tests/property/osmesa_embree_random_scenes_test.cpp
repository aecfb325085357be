// Random scenes against all references: whatever is drawn, nothing is different.
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "check/judge.h"
#include "pipeline/pipeline_renderer.h"
#include "random_scene.h"
#include "reference/embree/embree.h"
#include "reference/exact/exact.h"
#include "reference/osmesa/osmesa.h"

namespace plumbline {
namespace {

std::string failures(const check::SceneVerdict& verdict) {
  std::string out;
  for (const check::Comparison& c : verdict.comparisons) {
    if (!is_failure(c.outcome)) continue;
    const check::Worst& worst = c.measurement.worst;
    out += c.reference + " " + std::string(name_of(c.stage)) + " " + std::string(name_of(c.outcome)) + ": " +
           std::to_string(c.measurement.differing) + " of " + std::to_string(c.measurement.items) + ", " +
           to_string(worst.place) + ", ours " + std::to_string(worst.candidate) + ", theirs " +
           std::to_string(worst.reference) + ", " + std::to_string(worst.difference) + " > " +
           std::to_string(worst.tolerance) + " " + c.measurement.unit + " " + c.note + "\n";
  }
  return out;
}

check::SceneVerdict judge_by_all(const Scene& scene) {
  static const auto ours = pipeline::make_pipeline();
  static const auto osmesa = make_osmesa();
  static const auto embree = embree::make_embree();
  static const auto exact = exact::make_exact();
  const check::Reference references[] = {{"osmesa", osmesa.get()}, {"embree", embree.get()}, {"exact", exact.get()}};
  return check::judge(scene, *ours, references);
}

RC_GTEST_PROP(RandomScenes, HoldAgainstAllReferences, ()) {
  const std::string failed = failures(judge_by_all(test::random_scene()));
  if (!failed.empty()) RC_FAIL(failed);
}

RC_GTEST_PROP(RandomScenes, AntialiasedHoldAgainstAllReferences, ()) {
  if (*test::evenly(0, 8) != 0) return;  // one in eight: each is drawn up to six times, by Mesa with code made anew
  Scene scene = test::random_scene();
  scene.frame.antialias = *rc::gen::weightedElement<Antialias>({{3, {Antialias::Kind::multisample, 1}},
                                                                {1, {Antialias::Kind::supersample, 3}},
                                                                {1, {Antialias::Kind::taps, 1}}});
  const std::string failed = failures(judge_by_all(scene));
  if (!failed.empty()) RC_FAIL(failed);
}

bool finite(const glm::vec4& v) { return std::isfinite(v.x + v.y + v.z + v.w); }

RC_GTEST_PROP(RandomScenes, OfNumbersOfAnySizeLeaveNoNaN, ()) {
  const Scene scene = test::random_scene(test::any_float());
  for (const auto& renderer : {pipeline::make_pipeline(), exact::make_exact()}) {
    const Capture drawn = renderer->capture(scene, {});
    for (const glm::vec4& c : drawn.planes.color.values()) RC_ASSERT(finite(c));
    for (double z : drawn.planes.depth.values()) RC_ASSERT(z >= 0 && z <= 1);
  }
}

// The references may decline such scenes; none may crash or hang.
RC_GTEST_PROP(RandomScenes, OfNumbersOfAnySizeAreJudged, ()) {
  const Scene scene = test::random_scene(test::any_float());
  for (const check::Comparison& c : judge_by_all(scene).comparisons) {
    if (c.outcome == check::Outcome::failed) RC_FAIL(c.reference + ": " + c.note);
  }
}

}  // namespace
}  // namespace plumbline

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

RC_GTEST_PROP(RandomScenes, HoldAgainstAllReferences, ()) {
  static const auto ours = pipeline::make_pipeline();
  static const auto osmesa = make_osmesa();
  static const auto embree = embree::make_embree();
  static const auto exact = exact::make_exact();
  const check::Reference references[] = {{"osmesa", osmesa.get()}, {"embree", embree.get()}, {"exact", exact.get()}};
  const Scene scene = test::random_scene();
  const check::SceneVerdict verdict = check::judge(scene, *ours, references);
  const std::string failed = failures(verdict);
  if (!failed.empty()) RC_FAIL(failed);
}

}  // namespace
}  // namespace plumbline

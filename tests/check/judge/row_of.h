// Rows of one stage, by what a test knows of a candidate.
#pragma once

#include <functional>
#include <vector>

#include "check/judge/rows.h"
#include "reference/exact/exact.h"

namespace plumbline::check {

/// The first row that `judge(judgement, exact)` adds of a candidate; foreign by default.
inline Comparison row_of(const Scene& scene, const Capture& candidate, const Conventions& conventions,
                         const std::function<void(const SceneJudgement&, Renderer&)>& judge, bool foreign = true) {
  const Legal none;
  const auto exact = exact::make_exact();
  std::vector<Comparison> out;
  judge({.scene = scene,
         .candidate = candidate,
         .legal = none,
         .referee = exact.get(),
         .rows = out,
         .foreign = foreign,
         .conventions = conventions},
        *exact);
  return out.at(0);
}

/// The row of a stage that exact makes of the candidate's records.
inline Comparison row_of_stage(const Scene& scene, const Capture& candidate, Stage stage,
                               const Conventions& conventions, bool foreign = true) {
  return row_of(
      scene, candidate, conventions,
      [=](const SceneJudgement& c, Renderer& exact) { run_exact_stage(c, exact, stage, "exact"); }, foreign);
}

}  // namespace plumbline::check

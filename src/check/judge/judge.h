// A scene, the candidate and its references: the entry to the judges.
#pragma once

#include <cstdint>
#include <span>

#include "check/judge/judge_single.h"

namespace plumbline::check {

/// Verdict of a scene: by judge_passes() if it is antialiased, else by judge_single(). If a row differs, the scene is
/// judged once more with the `arbiters` as well, further references that supply legal answers and votes on the
/// reference; the verdict holds no rows of arbiters. `drawn`: receives both sides' captures, references in their order;
/// null: not wanted. Throws OverBudget.
SceneVerdict judge(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                   BothCaptures* drawn = nullptr, std::uint64_t most_fragments = ~std::uint64_t{0},
                   std::span<const Reference> arbiters = {});

}  // namespace plumbline::check

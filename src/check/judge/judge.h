// A scene, the candidate and its references: the entry to the judges.
#pragma once

#include <cstdint>
#include <span>

#include "check/judge/judge_single.h"

namespace plumbline::check {

/// judge_passes() of an antialiased scene, judge_single() of any other. Where a row differs, the scene is judged once
/// more beside the `arbiters`, further references that supply legal answers and votes on the reference. The verdict
/// holds no rows of theirs. `drawn`: receives both sides' captures, references in their order; null: not wanted. Throws
/// OverBudget.
SceneVerdict judge(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                   BothCaptures* drawn = nullptr, std::uint64_t most_fragments = ~std::uint64_t{0},
                   std::span<const Reference> arbiters = {});

}  // namespace plumbline::check

// A scene, the candidate and its references: the entry to the judges.
#pragma once

#include <cstdint>
#include <span>

#include "check/judge/judge_single.h"

namespace plumbline::check {

/// judge_passes() of an antialiased scene, judge_single() of any other. Where a row differs, the scene is judged once
/// more beside the `arbiters`, references that nobody asked for: they know which answers are legal, and whether it is
/// the reference that is wrong. The verdict holds no row of their own.
SceneVerdict judge(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                   BothCaptures* drawn = nullptr, std::uint64_t most_fragments = ~std::uint64_t{0},
                   std::span<const Reference> arbiters = {});

}  // namespace plumbline::check

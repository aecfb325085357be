// A scene of one sample a pixel, the candidate and its references: everything that can be compared is compared.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "capture/renderer.h"
#include "check/judge/reference.h"
#include "check/verdict/verdict.h"
#include "scene/scene.h"

namespace plumbline::check {

/// What both sides handed out, for a report's pictures.
struct BothCaptures {
  Capture candidate;
  std::vector<Capture> references;  ///< in the references' order; empty captures where there is none
};

/// A reference's role follows from its info (renderer.h), not from its name. The referee judges the candidate's own
/// records, stage by stage (Kind::per_stage); a reference of legal answers is an oracle for coverage, depth, visibility
/// and colour; everything else that a reference shows is compared side by side.
///
/// Records of the candidate's fragments are not captured where its planes count more than `most_fragments` fragments,
/// or where these records do not fit the memory budget. Legal answers of the whole frame are not asked for in the first
/// case, nor kept beyond the budget: the referee then gives them at the pixels where a reference has another winner.
/// Throws OverBudget, before a reference draws, where the candidate's capture does not fit even without fragments.
SceneVerdict judge_single(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn = nullptr, std::uint64_t most_fragments = ~std::uint64_t{0});

}  // namespace plumbline::check

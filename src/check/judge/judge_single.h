// A scene of one sample a pixel, the candidate and its references: everything that can be compared is compared.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "capture/renderer.h"
#include "check/judge/captures.h"
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
/// Leaves out records of the candidate's fragments that do not fit the memory budget or, of a candidate that is not
/// foreign, exceed `most_fragments`. Where planes.count sums to more than `most_fragments`, or the legal answers of the
/// whole frame do not fit the budget, the referee gives legal answers at the pixels alone where a reference has another
/// winner. Throws OverBudget, before a reference draws, where the candidate's capture without fragments does not fit.
SceneVerdict judge_single(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn = nullptr, std::uint64_t most_fragments = ~std::uint64_t{0});

}  // namespace plumbline::check

// Captures that a scene is judged by: the candidate's, and its references'; and where a candidate's fails.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/renderer.h"
#include "check/judge/refusal.h"
#include "scene/scene.h"

namespace plumbline::check {

/// A reference, or its absence.
struct Reference {
  std::string name;
  Renderer* renderer = nullptr;  ///< not owned; null: not built in
};

/// Whether planes.count sums to more than `most_fragments`.
bool more_than(std::uint64_t most_fragments, const Capture& capture);

/// The candidate's records and planes. Leaves out records of fragments that do not fit the memory budget or, of a
/// candidate that is not foreign, exceed `most_fragments`. Throws what Renderer::capture() throws.
Capture capture_all(const Scene& scene, Renderer& candidate, std::uint64_t most_fragments);

/// Captures and refusals of the references, in their order.
struct ReferenceCaptures {
  std::vector<Capture> captures;
  std::vector<std::optional<Refusal>> refusals;
};

/// Captures of the references: geometry records; coverage records where lines are drawn; planes. No planes of
/// referees, nor of oracles where `legal` is not set. Legal answers are captured if `legal` is set and the budget
/// allows.
ReferenceCaptures capture_references(const Scene& scene, std::span<const Reference> references, bool legal,
                                     const Conventions& conventions);

/// Legal answers at the pixels where a reference has another winner, count or sum of fragments. Empty where none has,
/// or the oracle fails.
Legal legal_where_apart(const Scene& scene, const Capture& mine, std::span<const Capture> theirs, Renderer& oracle,
                        const Conventions& conventions);

/// Records of a candidate whose capture failed: each stage that `shown` shows, run alone on the stages before, up to
/// the first stage that throws. `shown`: that stage and all later stages are then marked as not shown.
Capture run_alone(const Scene& scene, Renderer& candidate, RendererInfo& shown);

struct FailingStage {
  Stage stage;
  std::string how;  ///< the exception's message
};
/// First stage that throws when the candidate runs it alone, on the stages before as `referee` makes them, rounded to
/// the formats. None: the candidate runs no stages, the referee fails before, or no stage fails alone.
std::optional<FailingStage> failing_stage(const Scene& scene, Renderer& candidate, Renderer& referee);

}  // namespace plumbline::check

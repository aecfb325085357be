// An antialiased scene: each pass is judged as a scene of its own, then the resolved frame.
#pragma once

#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/judge/judge_single.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

/// Verdict of an antialiased scene: each row is the worst of the passes' rows (judge_single.h), with the items of all
/// passes; row `resolve` is of the whole picture. Each pass may have `most_fragments` divided by the number of passes.
SceneVerdict judge_passes(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn, std::uint64_t most_fragments);
/// Verdict of an antialiased scene whose passes have been judged. `passes`: the passes' verdicts, in order. `colors`:
/// the candidate's colours of each pass; an empty plane: none. A candidate with painters must have these colours as its
/// samples (exact's row `resolve`).
SceneVerdict judge_resolved(const Scene& scene, std::span<const SceneVerdict> passes,
                            std::span<const Plane<glm::vec4>> colors, Renderer& candidate,
                            std::span<const Reference> references, BothCaptures* drawn = nullptr);

/// Resolved colours against exact's unrounded mean of the candidate's own samples, within `factor` bounds of rounding
/// (ledger, exact.resolve); in frames of codes each channel must be a code.
Measurement compare_resolved(const Scene& scene, const Capture& candidate, const Capture& exact, double factor);
/// Samples of the candidate's frame, bit for bit, against `colors`: the candidate's colours of the passes, each pass
/// drawn as a scene of its own.
Measurement compare_samples(const Scene& scene, const Capture& candidate, std::span<const Plane<glm::vec4>> colors);
/// Disputed samples of a reference: per pass, the pixels (x, y) of the pass; and the reference's fault.
struct Disputed {
  std::vector<std::set<std::pair<int, int>>> at;
  std::string reason;
};
/// Resolved colours against those that a reference made of its own samples. Allowance: the weighted mean of the
/// undisputed samples' differences, which the passes judge, and roundings of both sides. Where all samples are equal,
/// codes must be equal, and floats may differ by what is flushed to zero. A larger difference is disputed if the
/// disputed samples' differences explain it.
Measurement compare_frames(const Scene& scene, const Capture& candidate, const Capture& reference,
                           const Disputed& disputed = {});

}  // namespace plumbline::check

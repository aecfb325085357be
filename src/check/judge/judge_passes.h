// An antialiased scene: each pass is judged as a scene of its own, then what is made of them.
#pragma once

#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "check/judge/judge_single.h"
#include "check/verdict/measure.h"

namespace plumbline::check {

/// Verdict of an antialiased scene: each row is the worst of its passes' (judge_single.h), with the items of all; row
/// `resolve` is of the whole picture.
SceneVerdict judge_passes(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                          BothCaptures* drawn);
/// The same, where the passes have been judged: their verdicts in order, and the candidate's colours of each (empty:
/// none). A candidate that draws passes of its own must draw these (exact's row `resolve`).
SceneVerdict judge_resolved(const Scene& scene, std::span<const SceneVerdict> passes,
                            std::span<const Plane<glm::vec4>> colors, Renderer& candidate,
                            std::span<const Reference> references, BothCaptures* drawn = nullptr);

/// Resolved colours, code by code, in proportion to what `factor` times the bound of rounding allows (ledger,
/// exact.resolve): against the mean that exact made of the candidate's own samples, not rounded.
Measurement compare_resolved(const Scene& scene, const Capture& candidate, const Capture& exact, double factor);
/// The samples of a frame, bit for bit, against the candidate's colours of the passes, each drawn as a scene of its
/// own.
Measurement compare_samples(const Scene& scene, const Capture& candidate, std::span<const Plane<glm::vec4>> colors);
/// By pass, the pixels where another's samples are its own fault; and the fault.
struct Disputed {
  std::vector<std::set<std::pair<int, int>>> at;
  std::string reason;
};
/// Resolved colours against those that a reference made of its own samples. Allowance: the weighted mean of the
/// samples' differences, which the passes judge, and a rounding on either side. Where all samples are equal, codes must
/// be equal, and floats may differ by what is flushed to zero. A larger difference that disputed samples explain is
/// disputed.
Measurement compare_frames(const Scene& scene, const Capture& candidate, const Capture& reference,
                           const Disputed& disputed = {});

}  // namespace plumbline::check

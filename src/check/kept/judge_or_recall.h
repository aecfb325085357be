// A verdict that was come to before stands as long as everything that it follows from is what it was.
#pragma once

#include <functional>
#include <set>
#include <span>
#include <string>

#include "check/judge/judge.h"
#include "check/kept/verdict_store.h"

namespace plumbline::check {

/// Verdicts of one set of judges.
struct KeptVerdicts {
  VerdictStore store;
  /// Changes whenever the judges would judge otherwise: their program, libraries, processor, settings.
  std::string judges;
  /// Whether a verdict that took so long is judged again, and compared with the kept one [s].
  std::function<bool(double seconds)> is_tried;
  std::set<std::string> words{};  ///< that verdicts of now refer to
};

/// One in 64; of those that took longer than a second, fewer in proportion.
bool tried_at_random(double seconds);

/// What judge() says of the scene. What it said before, where the scene's files, the candidate's description and its
/// answers to everything that it was asked, the references' versions and `judges` are what they were. The candidate
/// draws every time. Only verdicts without a failure are kept. Where a verdict that is tried is another than the kept
/// one, a row `failed` says so beside it. Without the pixels that differ (verdict_bytes.h) if recalled.
SceneVerdict judge_or_recall(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                             KeptVerdicts& kept, BothCaptures* drawn = nullptr);

}  // namespace plumbline::check

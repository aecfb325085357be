// Verdicts of earlier runs: each stands as long as everything that it follows from is what it was.
#pragma once

#include <filesystem>
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
  /// Start of the run, before it read scenes: of a scene whose files were written since, nobody knows which was read.
  std::filesystem::file_time_type began;
  std::set<std::string> words{};  ///< field names (Place::field) of recalled verdicts
};

/// One in 64; of those that took longer than a second, fewer in proportion.
bool tried_at_random(double seconds);

/// Verdict of judge(); or the kept one, where the scene's files, the candidate's description and its answers to
/// everything that it was asked, the references' versions and `judges` are what they were. The candidate draws every
/// time. Only verdicts without a failure are kept. Where a verdict that is tried is another than the kept one, a row
/// `failed` says so beside it. A kept one is without the pixels that differ (verdict_bytes.h), and leaves `drawn` empty.
SceneVerdict judge_or_recall(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                             KeptVerdicts& kept, BothCaptures* drawn = nullptr,
                             std::span<const Reference> arbiters = {});

}  // namespace plumbline::check

// Verdicts kept from earlier runs; each is reused while all that it depends on is unchanged.
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
  /// Whether a kept verdict that took `seconds` [s] is judged again and compared.
  std::function<bool(double seconds)> is_tried;
  /// Start of the run, before it read scenes. Scenes with a file written since are always judged, and not kept.
  std::filesystem::file_time_type began;
  std::set<std::string> words{};  ///< field names (Place::field) of recalled verdicts
};

/// True with probability 1/64; above one second, 1/64 divided by the seconds.
bool tried_at_random(double seconds);

/// Verdict of judge(); or the kept one, where the scene's files, the candidate's description and its answers to
/// everything that it was asked, the references' versions and `judges` are what they were. The candidate draws every
/// time. Only verdicts without a failure are kept. A verdict judged again that differs from the kept one gets a row
/// `failed`. A recalled verdict is without the pixels that differ (verdict_bytes.h), and leaves `drawn` empty.
SceneVerdict judge_or_recall(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                             KeptVerdicts& kept, BothCaptures* drawn = nullptr,
                             std::span<const Reference> arbiters = {});

}  // namespace plumbline::check

#include "check/judge/judge.h"

#include <algorithm>
#include <vector>

#include "check/judge/judge_passes.h"

namespace plumbline::check {

SceneVerdict judge(const Scene& scene, Renderer& candidate, std::span<const Reference> references, BothCaptures* drawn,
                   std::uint64_t most_fragments, std::span<const Reference> arbiters) {
  const auto judge_by = [&](std::span<const Reference> all) {
    return antialiased(scene) ? judge_passes(scene, candidate, all, drawn, most_fragments)
                              : judge_single(scene, candidate, all, drawn, most_fragments);
  };
  SceneVerdict verdict = judge_by(references);
  const auto differs = [](const Comparison& row) { return row.outcome == Outcome::different; };
  if (arbiters.empty() || std::ranges::none_of(verdict.comparisons, differs)) return verdict;
  std::vector<Reference> all(references.begin(), references.end());
  all.insert(all.end(), arbiters.begin(), arbiters.end());
  const double seconds = verdict.seconds;
  verdict = judge_by(all);
  verdict.seconds += seconds;
  std::erase_if(verdict.comparisons, [&](const Comparison& row) {
    return std::ranges::find(arbiters, row.judge.reference, &Reference::name) != arbiters.end();
  });
  if (drawn != nullptr) drawn->references.resize(references.size());
  return verdict;
}

}  // namespace plumbline::check

#include "check/judge/judge.h"

#include <algorithm>
#include <vector>

#include "check/judge/judge_passes.h"

namespace plumbline::check {

namespace {

SceneVerdict judge_by(const Scene& scene, Renderer& candidate, std::span<const Reference> references,
                      BothCaptures* drawn, std::uint64_t most_fragments) {
  if (antialiased(scene)) return judge_passes(scene, candidate, references, drawn, most_fragments);
  return judge_single(scene, candidate, references, drawn, most_fragments);
}

}  // namespace

SceneVerdict judge(const Scene& scene, Renderer& candidate, std::span<const Reference> references, BothCaptures* drawn,
                   std::uint64_t most_fragments, std::span<const Reference> arbiters) {
  SceneVerdict verdict = judge_by(scene, candidate, references, drawn, most_fragments);
  const auto differs = [](const Comparison& row) { return row.outcome == Outcome::different; };
  if (arbiters.empty() || std::ranges::none_of(verdict.comparisons, differs)) return verdict;
  std::vector<Reference> all(references.begin(), references.end());
  all.insert(all.end(), arbiters.begin(), arbiters.end());
  const double seconds = verdict.seconds;
  verdict = judge_by(scene, candidate, all, drawn, most_fragments);
  verdict.seconds += seconds;
  std::erase_if(verdict.comparisons, [&](const Comparison& row) {
    return std::ranges::find(arbiters, row.judge.reference, &Reference::name) != arbiters.end();
  });
  if (drawn != nullptr) drawn->references.resize(references.size());
  return verdict;
}

}  // namespace plumbline::check

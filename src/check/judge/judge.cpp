#include "check/judge/judge.h"

#include "check/judge/judge_passes.h"

namespace plumbline::check {

SceneVerdict judge(const Scene& scene, Renderer& candidate, std::span<const Reference> references, BothCaptures* drawn,
                   std::uint64_t most_fragments) {
  if (scene.frame.antialias.kind != Antialias::Kind::none) return judge_passes(scene, candidate, references, drawn);
  return judge_single(scene, candidate, references, drawn, most_fragments);
}

}  // namespace plumbline::check

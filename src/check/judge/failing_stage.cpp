#include "check/judge/failing_stage.h"

#include <exception>

#include "check/judge/stage_copy.h"

namespace plumbline::check {

std::optional<FailingStage> failing_stage(const Scene& scene, Renderer& candidate, Renderer& referee) {
  const RendererInfo info = candidate.info();
  Capture in;
  in.width = scene.frame.width;
  in.height = scene.frame.height;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(Stage::merge); ++i) {
    const auto stage = static_cast<Stage>(i);
    if (stage == Stage::texture && !textured(scene)) continue;
    try {
      if (info[stage].runs) candidate.run_stage(scene, stage, in);
    } catch (const std::exception& e) {
      return FailingStage{stage, e.what()};
    }
    try {
      copy_stage(stage, referee.run_stage(scene, stage, in), in);
    } catch (const std::exception&) {
      return std::nullopt;
    }
    round_to_formats(scene, stage, in);
  }
  return std::nullopt;
}

}  // namespace plumbline::check

#include "check/judge/failing_stage.h"

#include <exception>

#include "check/judge/stage_copy.h"

namespace plumbline::check {

std::optional<FailingStage> failing_stage(const Scene& scene, Renderer& candidate, Renderer& referee) {
  const RendererInfo info = candidate.info();
  Capture in;
  in.width = scene.frame.width;
  in.height = scene.frame.height;
  for (const Stage stage : stages_of(scene)) {
    try {
      if (info[stage].runs) candidate.run_stage(scene, stage, in);
    } catch (const Unsupported&) {  // no failure
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

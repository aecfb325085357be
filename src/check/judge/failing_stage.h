// A candidate that fails while it draws: the stage at which.
#pragma once

#include <optional>
#include <string>

#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

struct FailingStage {
  Stage stage;
  std::string how;
};
/// The first stage on which the candidate fails alone, each run on what `referee` makes of the stages before it. None:
/// it runs no stages, the referee does not get so far, or no stage fails alone.
std::optional<FailingStage> failing_stage(const Scene& scene, Renderer& candidate, Renderer& referee);

}  // namespace plumbline::check

// The stage at which a candidate fails while it draws.
#pragma once

#include <optional>
#include <string>

#include "capture/renderer.h"
#include "scene/scene.h"

namespace plumbline::check {

struct FailingStage {
  Stage stage;
  std::string how;  ///< the exception's message
};
/// First stage that throws when the candidate runs it alone, on the stages before as `referee` makes them, rounded to
/// the formats. None: the candidate runs no stages, the referee fails before, or no stage fails alone.
std::optional<FailingStage> failing_stage(const Scene& scene, Renderer& candidate, Renderer& referee);

}  // namespace plumbline::check

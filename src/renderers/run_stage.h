// One stage of the pipeline alone, on the records of a capture.
#pragma once

#include "capture/capture.h"
#include "pipeline/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Adds the stage's records and planes to `out`, made of what `in` holds of the stages before (Renderer::run_stage).
/// Throws std::invalid_argument naming the records that do not fit. Not of resolve.
void run_stage(const Scene& scene, Stage stage, const Stages& stages, const Capture& in, Capture& out);

}  // namespace plumbline::pipeline

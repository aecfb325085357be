// Checks that records from outside fit a scene and each other, so that a stage can be run on them.
#pragma once

#include "capture/capture.h"

namespace plumbline {

/// What the stage reads of `in`. Throws std::invalid_argument naming the records that do not fit.
void require_fitting(const Scene& scene, Stage stage, const Capture& in);

}  // namespace plumbline

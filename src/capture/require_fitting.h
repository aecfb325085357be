// Checks that records from outside fit a scene and each other, so that a stage can be run on them.
#pragma once

#include "capture/capture.h"

namespace plumbline {

/// Throws std::invalid_argument that names the records of `in` which the stage reads and which do not fit the scene.
void require_fitting(const Scene& scene, Stage stage, const Capture& in);

}  // namespace plumbline

// Stage 0: a draw's transforms, camera, projection and viewport become matrices. (dialect.h has camera and projection.)
#pragma once

#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::pipeline {

/// Built in double, rounded once to float (entries below 1e-12 become 0).
Matrices<float> matrices(const Scene& scene, const Draw& draw);

}  // namespace plumbline::pipeline

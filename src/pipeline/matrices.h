// Stage 0: a draw's transforms, camera, projection and viewport become matrices; the camera takes lights to eye space.
// (dialect.h has camera and projection.)
#pragma once

#include "base/fixed_vector.h"
#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Built in double, rounded once to float (entries below 1e-12 become 0).
Matrices<float> matrices(const Scene& scene, const Draw& draw);

/// One for each of the scene's lights, built in double, rounded once to float.
FixedVector<LightSource<float>, 8> light_sources(const Scene& scene);

}  // namespace plumbline::pipeline

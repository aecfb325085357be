// Stage 0: a draw's transforms, camera, projection and viewport become matrices.
#pragma once

#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::pipeline {

/// World to eye space (gluLookAt): the eye at the origin, looking down -z.
glm::dmat4 look_at(const Camera& camera);

/// Eye to clip space (GL 2.1 spec 2.11.2). Perspective: glFrustum's matrix by the vertical field of view
/// (gluPerspective); frustum: glFrustum's; orthographic: glOrtho's. `aspect` = width / height.
glm::dmat4 project(const Projection& projection, double aspect);

/// Built in double, rounded once to float (entries below 1e-12 become 0).
Matrices<float> matrices(const Scene& scene, const Draw& draw);

}  // namespace plumbline::pipeline

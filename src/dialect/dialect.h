// The conventions under which a scene's numbers are read, resolved once, before the pipeline: whatever the dialect,
// what comes out is OpenGL's. Eye space is right-handed, the eye at its origin, looking down -z. Inside the view volume
// is -w <= x, y, z <= w. The window is counted in the dialect's own row order, row 0 first, pixel centres at halves.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline {

/// World to eye space.
glm::dmat4 view_matrix(const Scene& scene);

/// Eye to clip space. The scene's projection must be one of its dialect's (scene.h): else std::invalid_argument.
glm::dmat4 projection_matrix(const Scene& scene);

}  // namespace plumbline

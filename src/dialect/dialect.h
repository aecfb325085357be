// Dialects: the conventions under which a scene's numbers are read (scene.h). These two matrices, of stage 0, resolve
// them: eye and clip space are OpenGL's in every dialect. Eye space is right-handed, the eye at its origin, looking
// down -z. The view volume is -w <= x, y, z <= w. Rows of the window stay in the dialect's order, row 0 first; pixel
// centres are at half-integers.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline {

/// World to eye space. Throws as projection_matrix(), in gzrender and tinyrenderer, where the eye's place depends on
/// the projection.
glm::dmat4 view_matrix(const Scene& scene);

/// Eye to clip space, moved by the pass' shift (Pass, scene.h). Throws std::invalid_argument where the projection is
/// not one of the scene's dialect.
glm::dmat4 projection_matrix(const Scene& scene);

}  // namespace plumbline

// Stage 0 in double: a scene's camera, projection and transforms as matrices, by GLM.
#pragma once

#include <glm/glm.hpp>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::math {

/// p_eye = view_matrix * p_world, whatever the dialect: right-handed, the eye at 0, looking down -z. Unrounded.
glm::dmat4 view_matrix(const Scene& scene);

/// The draw's matrices, unrounded. model_view = view * T1 * T2 * ... in the order written; win_scale and win_translate
/// are (width/2, height/2, 1/2), in pixels and window z.
Matrices<double> double_matrices(const Scene& scene, const Draw& draw);

/// The same, as the project's renderers hold them: each entry below 1e-12 is 0, the others are rounded once to float.
Matrices<double> float_matrices(const Scene& scene, const Draw& draw);

}  // namespace plumbline::math

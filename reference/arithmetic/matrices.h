// Stage 0 in double: a scene's camera, projection and transforms as matrices, by GLM.
#pragma once

#include <optional>

#include <glm/glm.hpp>

#include "capture/conventions.h"
#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::math {

/// World to eye space, p_eye = view_matrix * p_world, unrounded. In each dialect, eye space is right-handed, the eye at
/// 0 looking down -z.
glm::dmat4 view_matrix(const Scene& scene);

/// The draw's matrices, unrounded. model_view = view * T1 * T2 * ... in the order written. In pixels and window z,
/// win_scale is (width, height, far - near) / 2 and win_translate (width, height, far + near) / 2, near and far of the
/// draw's depth range.
Matrices<double> double_matrices(const Scene& scene, const Draw& draw);

/// double_matrices() as the project's renderers hold them: entries below 1e-12 in absolute value are 0 (not those of
/// win_scale and win_translate), all are rounded once to float.
Matrices<double> float_matrices(const Scene& scene, const Draw& draw);

/// z_view (projected.h) of points where 1/w is 0 or, without perspective, where the distance before the eye is 0;
/// nullopt where z_ndc is not a constant plus a multiple of that number.
std::optional<double> z_view_of_zero(const glm::dmat4& projection, Conventions::ClipDepth volume);

}  // namespace plumbline::math

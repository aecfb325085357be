// How far a float evaluation of a vertex' colour may be from the one in double.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "scene/scene.h"
#include "stages/stages.h"

namespace plumbline::math {

/// Per channel, for vertex number `vertex` of the draw's mesh; `m` and `view` unrounded. At most 1: colours are
/// clamped. Infinite where a cone's edge may be on either side of the vertex.
double color_error(const Scene& scene, const Draw& draw, const Matrices<double>& m, const glm::dmat4& view,
                   std::uint32_t vertex);

}  // namespace plumbline::math

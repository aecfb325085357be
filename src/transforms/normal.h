// How normals go when points go by a matrix.
#pragma once

#include <glm/glm.hpp>

namespace plumbline::transforms {

/// The inverse transpose of the upper 3 x 3, TinyRenderer (002) "Transformation Of Normal Vectors": what is at right
/// angles to a surface stays so. Lengths change; a singular matrix gives infinities or NaN.
glm::dmat3 normal_matrix(const glm::dmat4& m);
/// What takes such normals back: the transpose.
glm::dmat3 inverse_normal_matrix(const glm::dmat4& m);

}  // namespace plumbline::transforms

// Matrices of normals, from the matrix of the points.
#pragma once

#include <glm/glm.hpp>

namespace plumbline::transforms {

/// The inverse transpose of m's upper left 3 x 3, TinyRenderer (002) "Transformation Of Normal Vectors": it keeps
/// normals at right angles to their surface. Lengths change; a singular matrix gives infinities or NaN.
glm::dmat3 normal_matrix(const glm::dmat4& m);
/// The inverse of normal_matrix(m): the transpose of m's upper left 3 x 3.
glm::dmat3 inverse_normal_matrix(const glm::dmat4& m);

}  // namespace plumbline::transforms

#include "transforms/normal.h"

namespace plumbline::transforms {

// The inverse is transpose(cofactors) / determinant (Cramer), so the inverse transpose is cofactors / determinant.
glm::dmat3 normal_matrix(const glm::dmat4& matrix) {
  const glm::dmat3 m(matrix);
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const double determinant = m[0].x * cofactors[0].x + m[1].x * cofactors[1].x + m[2].x * cofactors[2].x;
  return cofactors * (1.0 / determinant);
}

glm::dmat3 inverse_normal_matrix(const glm::dmat4& m) { return glm::transpose(glm::dmat3(m)); }

}  // namespace plumbline::transforms

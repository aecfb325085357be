#include "transforms/viewport.h"

namespace plumbline::transforms {
namespace {

// p_win = scale p_ndc + move.
glm::dmat4 matrix(const glm::dvec3& scale, const glm::dvec3& move) {
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i][i] = scale[i];
  m[3] = glm::dvec4(move, 1.0);
  return m;
}

// p_ndc = p_win / scale - move / scale.
glm::dmat4 inverse_matrix(const glm::dvec3& scale, const glm::dvec3& move) {
  return matrix(1.0 / scale, -move / scale);
}

}  // namespace

namespace gzrender {

glm::dmat4 x_sp(double xs, double ys, double maxint) {
  return matrix({xs / 2.0, -ys / 2.0, maxint}, {xs / 2.0, ys / 2.0, 0.0});
}
glm::dmat4 inverse_x_sp(double xs, double ys, double maxint) {
  return inverse_matrix({xs / 2.0, -ys / 2.0, maxint}, {xs / 2.0, ys / 2.0, 0.0});
}

}  // namespace gzrender

namespace games101 {

glm::dmat4 viewport(double width, double height) {
  return matrix({width / 2.0, height / 2.0, 1.0}, {width / 2.0, height / 2.0, 0.0});
}
glm::dmat4 inverse_viewport(double width, double height) {
  return inverse_matrix({width / 2.0, height / 2.0, 1.0}, {width / 2.0, height / 2.0, 0.0});
}

}  // namespace games101

namespace tinyrenderer {

glm::dmat4 viewport(double x, double y, double w, double h, double depth) {
  return matrix({w / 2.0, h / 2.0, depth / 2.0}, {x + w / 2.0, y + h / 2.0, depth / 2.0});
}
glm::dmat4 inverse_viewport(double x, double y, double w, double h, double depth) {
  return inverse_matrix({w / 2.0, h / 2.0, depth / 2.0}, {x + w / 2.0, y + h / 2.0, depth / 2.0});
}

}  // namespace tinyrenderer

}  // namespace plumbline::transforms

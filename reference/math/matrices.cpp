#include "reference/math/matrices.h"

#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace plumbline::math {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

glm::dmat4 projection_matrix(const Scene& scene) {
  return std::visit(
      Overloaded{[&](const Perspective& p) {
                   const double aspect = static_cast<double>(scene.frame.width) / scene.frame.height;
                   return glm::perspective(glm::radians(p.fov_y_degrees), aspect, p.near, p.far);
                 },
                 [](const Orthographic& o) { return glm::ortho(o.left, o.right, o.bottom, o.top, o.near, o.far); },
                 [](const Frustum& f) { return glm::frustum(f.left, f.right, f.bottom, f.top, f.near, f.far); }},
      scene.projection);
}

glm::dmat4 times(const glm::dmat4& m, const Transform& transform) {
  return std::visit(Overloaded{[&](const Translate& t) { return glm::translate(m, t.by); },
                               [&](const Rotate& r) { return glm::rotate(m, glm::radians(r.degrees), r.axis); },
                               [&](const Scale& s) { return glm::scale(m, s.by); }},
                    transform);
}

double once_to_float(double entry) { return std::abs(entry) < 1e-12 ? 0.0 : static_cast<float>(entry); }

template <class M>
void round_entries(M& matrix) {
  for (int column = 0; column < M::length(); ++column)
    for (int row = 0; row < M::col_type::length(); ++row) matrix[column][row] = once_to_float(matrix[column][row]);
}

}  // namespace

glm::dmat4 view_matrix(const Scene& scene) {
  return glm::lookAt(scene.camera.eye, scene.camera.center, scene.camera.up);
}

Matrices<double> double_matrices(const Scene& scene, const Draw& draw) {
  Matrices<double> m;
  m.model_view = view_matrix(scene);
  for (const Transform& transform : draw.transforms) m.model_view = times(m.model_view, transform);
  m.projection = projection_matrix(scene);
  m.normal = glm::transpose(glm::inverse(glm::dmat3(m.model_view)));
  m.win_scale = glm::dvec3(scene.frame.width, scene.frame.height, 1) * 0.5;
  m.win_translate = m.win_scale;
  return m;
}

Matrices<double> float_matrices(const Scene& scene, const Draw& draw) {
  Matrices<double> m = double_matrices(scene, draw);
  round_entries(m.model_view);
  round_entries(m.projection);
  round_entries(m.normal);
  return m;
}

}  // namespace plumbline::math

#include "pipeline/matrices.h"

#include <cmath>

namespace plumbline::pipeline {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

// Columns are what the axes become; w is the translation.
glm::dmat4 matrix_of(const Translate& t) {
  glm::dmat4 m(1.0);
  m[3] = glm::dvec4(t.by, 1.0);
  return m;
}

glm::dmat4 matrix_of(const Scale& s) {
  glm::dmat4 m(1.0);
  m[0][0] = s.by.x;
  m[1][1] = s.by.y;
  m[2][2] = s.by.z;
  return m;
}

// Rodrigues: R = c I + (1 - c) a a^T + s [a]x (the matrix of glRotate).
glm::dmat4 matrix_of(const Rotate& r) {
  const double length = std::sqrt(r.axis.x * r.axis.x + r.axis.y * r.axis.y + r.axis.z * r.axis.z);
  const double x = r.axis.x / length, y = r.axis.y / length, z = r.axis.z / length;
  const double c = std::cos(r.degrees * kRadians), s = std::sin(r.degrees * kRadians), k = 1.0 - c;
  glm::dmat4 m(1.0);
  m[0] = {x * x * k + c, y * x * k + z * s, x * z * k - y * s, 0.0};
  m[1] = {x * y * k - z * s, y * y * k + c, y * z * k + x * s, 0.0};
  m[2] = {x * z * k + y * s, y * z * k - x * s, z * z * k + c, 0.0};
  return m;
}

template <class Matrix>
auto rounded(const Matrix& m) {
  using Column = typename Matrix::col_type;
  glm::mat<Column::length(), Column::length(), float> out;
  for (int column = 0; column < Column::length(); ++column) {
    for (int row = 0; row < Column::length(); ++row) {
      const double value = m[column][row];
      out[column][row] = std::abs(value) < 1e-12 ? 0.0f : static_cast<float>(value);
    }
  }
  return out;
}

}  // namespace

glm::dmat4 look_at(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.center - camera.eye);
  const glm::dvec3 side = glm::normalize(glm::cross(forward, camera.up));
  const glm::dvec3 up = glm::cross(side, forward);
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) {
    m[i][0] = side[i];
    m[i][1] = up[i];
    m[i][2] = -forward[i];
  }
  m[3] = {-glm::dot(side, camera.eye), -glm::dot(up, camera.eye), glm::dot(forward, camera.eye), 1.0};
  return m;
}

glm::dmat4 project(const Projection& projection, double aspect) {
  glm::dmat4 m(0.0);
  if (const auto* p = std::get_if<Perspective>(&projection)) {
    const double f = 1.0 / std::tan(p->fov_y_degrees * kRadians / 2.0);
    m[0][0] = f / aspect;
    m[1][1] = f;
    m[2][2] = (p->far + p->near) / (p->near - p->far);
    m[2][3] = -1.0;
    m[3][2] = 2.0 * p->far * p->near / (p->near - p->far);
    return m;
  }
  if (const auto* p = std::get_if<Frustum>(&projection)) {
    m[0][0] = 2.0 * p->near / (p->right - p->left);
    m[1][1] = 2.0 * p->near / (p->top - p->bottom);
    m[2] = {(p->right + p->left) / (p->right - p->left), (p->top + p->bottom) / (p->top - p->bottom),
            (p->near + p->far) / (p->near - p->far), -1.0};
    m[3][2] = 2.0 * p->far * p->near / (p->near - p->far);
    return m;
  }
  const auto& o = std::get<Orthographic>(projection);
  m[0][0] = 2.0 / (o.right - o.left);
  m[1][1] = 2.0 / (o.top - o.bottom);
  m[2][2] = -2.0 / (o.far - o.near);
  m[3] = {-(o.right + o.left) / (o.right - o.left), -(o.top + o.bottom) / (o.top - o.bottom),
          -(o.far + o.near) / (o.far - o.near), 1.0};
  return m;
}

Matrices<float> matrices(const Scene& scene, const Draw& draw) {
  glm::dmat4 model_view = look_at(scene.camera);
  for (const Transform& transform : draw.transforms) {
    model_view = model_view * std::visit([](const auto& t) { return matrix_of(t); }, transform);
  }
  const double width = scene.frame.width, height = scene.frame.height;
  Matrices<float> out;
  out.model_view = rounded(model_view);
  out.projection = rounded(project(scene.projection, width / height));
  out.normal = rounded(glm::transpose(glm::inverse(glm::dmat3(model_view))));
  out.win_scale = {static_cast<float>(width / 2), static_cast<float>(height / 2), 0.5f};
  out.win_translate = out.win_scale;
  return out;
}

}  // namespace plumbline::pipeline

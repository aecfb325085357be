#include "pipeline/geometry.h"

#include <cmath>

#include "dialect/dialect.h"
#include "kernels/math.h"
#include "transforms/normal.h"
#include "transforms/transform.h"

namespace plumbline::pipeline {

namespace {

glm::dmat4 matrix_of(const Translate& t) { return transforms::translation(t.by); }
glm::dmat4 matrix_of(const Scale& s) { return transforms::scaling(s.by); }
glm::dmat4 matrix_of(const Rotate& r) { return transforms::rotation(r.degrees * kRadians, r.axis); }

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

Matrices<float> matrices(const Scene& scene, const Draw& draw) {
  glm::dmat4 model_view = view_matrix(scene);
  for (const Transform& transform : draw.transforms) {
    model_view = model_view * std::visit([](const auto& t) { return matrix_of(t); }, transform);
  }
  const double width = scene.frame.width, height = scene.frame.height;
  Matrices<float> out;
  out.model_view = rounded(model_view);
  out.projection = rounded(projection_matrix(scene));
  out.normal = rounded(transforms::normal_matrix(model_view));
  const double near = draw.depth_range.near, far = draw.depth_range.far;
  out.win_scale = {static_cast<float>(width / 2), static_cast<float>(height / 2), static_cast<float>((far - near) / 2)};
  out.win_translate = {out.win_scale.x, out.win_scale.y, static_cast<float>((far + near) / 2)};
  return out;
}

FixedVector<LightSource<float>, 8> light_sources(const Scene& scene) {
  const glm::dmat4 view = view_matrix(scene);
  const auto eye = [&](const glm::dvec3& v, double w) { return Vec3<float>(view * glm::dvec4(v, w)); };
  FixedVector<LightSource<float>, 8> out;
  for (const Light& light : scene.lights) {
    const bool point = light.kind == Light::Kind::point;
    const Vec4<float> p_eye(eye(light.vector, point ? 1.0 : 0.0), point ? 1.0f : 0.0f);
    out.push_back({p_eye, point && light.spot ? eye(light.spot->direction, 0) : Vec3<float>(0)});
  }
  return out;
}

}  // namespace plumbline::pipeline

#include "transforms/projection.h"

#include <cmath>

#include "transforms/transform.h"

namespace plumbline::transforms {

NearPlane near_plane(const FieldOfView& view, double n) {
  const double t = std::tan(view.fov_y / 2.0) * std::abs(n), r = t * view.aspect;
  return {-r, r, -t, t};
}

FieldOfView field_of_view(const NearPlane& plane, double n) {
  return {2.0 * std::atan(plane.top / std::abs(n)), plane.right / plane.top};
}

namespace gl {

glm::dmat4 frustum(double l, double r, double b, double t, double n, double f) {
  glm::dmat4 m(0.0);
  m[0][0] = 2.0 * n / (r - l);
  m[1][1] = 2.0 * n / (t - b);
  m[2] = {(r + l) / (r - l), (t + b) / (t - b), (n + f) / (n - f), -1.0};
  m[3][2] = 2.0 * f * n / (n - f);
  return m;
}

// With z_clip = A z + B and w_clip = -z, A = (n + f) / (n - f) and B = 2 f n / (n - f): z = -w_clip and
// 1 = (z_clip + A w_clip) / B.
glm::dmat4 inverse_frustum(double l, double r, double b, double t, double n, double f) {
  glm::dmat4 m(0.0);
  m[0][0] = (r - l) / (2.0 * n);
  m[1][1] = (t - b) / (2.0 * n);
  m[2][3] = (n - f) / (2.0 * f * n);
  m[3] = {(r + l) / (2.0 * n), (t + b) / (2.0 * n), -1.0, (n + f) / (2.0 * f * n)};
  return m;
}

glm::dmat4 orthographic(double l, double r, double b, double t, double n, double f) {
  glm::dmat4 m(0.0);
  m[0][0] = 2.0 / (r - l);
  m[1][1] = 2.0 / (t - b);
  m[2][2] = -2.0 / (f - n);
  m[3] = {-(r + l) / (r - l), -(t + b) / (t - b), -(f + n) / (f - n), 1.0};
  return m;
}

glm::dmat4 inverse_orthographic(double l, double r, double b, double t, double n, double f) {
  glm::dmat4 m(0.0);
  m[0][0] = (r - l) / 2.0;
  m[1][1] = (t - b) / 2.0;
  m[2][2] = (n - f) / 2.0;
  m[3] = {(r + l) / 2.0, (t + b) / 2.0, -(n + f) / 2.0, 1.0};
  return m;
}

glm::dmat4 perspective(const FieldOfView& view, double n, double f) {
  const double cotangent = 1.0 / std::tan(view.fov_y / 2.0);
  glm::dmat4 m(0.0);
  m[0][0] = cotangent / view.aspect;
  m[1][1] = cotangent;
  m[2][2] = (f + n) / (n - f);
  m[2][3] = -1.0;
  m[3][2] = 2.0 * f * n / (n - f);
  return m;
}

glm::dmat4 inverse_perspective(const FieldOfView& view, double n, double f) {
  const double tangent = std::tan(view.fov_y / 2.0);
  glm::dmat4 m(0.0);
  m[0][0] = tangent * view.aspect;
  m[1][1] = tangent;
  m[2][3] = (n - f) / (2.0 * f * n);
  m[3] = {0.0, 0.0, -1.0, (n + f) / (2.0 * f * n)};
  return m;
}

}  // namespace gl

namespace gzrender {

double d_of_fov(double fov) { return 1.0 / std::tan(fov / 2.0); }
double fov_of_d(double d) { return 2.0 * std::atan(1.0 / d); }

glm::dmat4 x_pi(double d) {
  glm::dmat4 m(1.0);
  m[2][2] = m[2][3] = 1.0 / d;
  return m;
}

// With z' = Z / d and w' = Z / d + 1: Z = d z' and 1 = w' - z'.
glm::dmat4 inverse_x_pi(double d) {
  glm::dmat4 m(1.0);
  m[2][2] = d;
  m[2][3] = -1.0;
  return m;
}

}  // namespace gzrender

namespace games101 {

glm::dmat4 orthographic(double l, double r, double b, double t, double n, double f) {
  const glm::dvec3 size(r - l, t - b, n - f), middle((r + l) / 2.0, (t + b) / 2.0, (n + f) / 2.0);
  return scaling(2.0 / size) * inverse_translation(middle);
}

glm::dmat4 inverse_orthographic(double l, double r, double b, double t, double n, double f) {
  const glm::dvec3 size(r - l, t - b, n - f), middle((r + l) / 2.0, (t + b) / 2.0, (n + f) / 2.0);
  return translation(middle) * scaling(size / 2.0);
}

glm::dmat4 persp_to_ortho(double n, double f) {
  glm::dmat4 m(0.0);
  m[0][0] = m[1][1] = n;
  m[2] = {0.0, 0.0, n + f, 1.0};
  m[3][2] = -n * f;
  return m;
}

// With z' = (n + f) z - n f and w' = z: z = w' and 1 = ((n + f) w' - z') / (n f).
glm::dmat4 inverse_persp_to_ortho(double n, double f) {
  glm::dmat4 m(0.0);
  m[0][0] = m[1][1] = 1.0 / n;
  m[2][3] = -1.0 / (n * f);
  m[3] = {0.0, 0.0, 1.0, (n + f) / (n * f)};
  return m;
}

glm::dmat4 perspective(const FieldOfView& view, double n, double f) {
  const NearPlane p = near_plane(view, n);
  return orthographic(p.left, p.right, p.bottom, p.top, n, f) * persp_to_ortho(n, f);
}

glm::dmat4 inverse_perspective(const FieldOfView& view, double n, double f) {
  const NearPlane p = near_plane(view, n);
  return inverse_persp_to_ortho(n, f) * inverse_orthographic(p.left, p.right, p.bottom, p.top, n, f);
}

}  // namespace games101

namespace tinyrenderer {

glm::dmat4 projection(double c) {
  glm::dmat4 m(1.0);
  m[2][3] = -1.0 / c;
  return m;
}

glm::dmat4 inverse_projection(double c) {
  glm::dmat4 m(1.0);
  m[2][3] = 1.0 / c;
  return m;
}

}  // namespace tinyrenderer

}  // namespace plumbline::transforms

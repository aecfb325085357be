#include "transforms/transform.h"

#include <cmath>

#include "transforms/look_at.h"

namespace plumbline::transforms {

// A matrix' first three columns are the images of the axes, its last the translation.
glm::dmat4 translation(const glm::dvec3& t) {
  glm::dmat4 m(1.0);
  m[3] = glm::dvec4(t, 1.0);
  return m;
}

glm::dmat4 inverse_translation(const glm::dvec3& t) { return translation(-t); }

glm::dmat4 scaling(const glm::dvec3& s) {
  glm::dmat4 m(1.0);
  m[0][0] = s.x;
  m[1][1] = s.y;
  m[2][2] = s.z;
  return m;
}

glm::dmat4 inverse_scaling(const glm::dvec3& s) { return scaling(1.0 / s); }

glm::dmat4 rotation_x(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat4 m(1.0);
  m[1] = {0.0, c, s, 0.0};
  m[2] = {0.0, -s, c, 0.0};
  return m;
}

glm::dmat4 rotation_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat4 m(1.0);
  m[0] = {c, 0.0, -s, 0.0};
  m[2] = {s, 0.0, c, 0.0};
  return m;
}

glm::dmat4 rotation_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  glm::dmat4 m(1.0);
  m[0] = {c, s, 0.0, 0.0};
  m[1] = {-s, c, 0.0, 0.0};
  return m;
}

glm::dmat4 inverse_rotation_x(double angle) { return glm::transpose(rotation_x(angle)); }
glm::dmat4 inverse_rotation_y(double angle) { return glm::transpose(rotation_y(angle)); }
glm::dmat4 inverse_rotation_z(double angle) { return glm::transpose(rotation_z(angle)); }

glm::dmat4 rotation(double angle, const glm::dvec3& axis) {
  const double length = std::sqrt(axis.x * axis.x + axis.y * axis.y + axis.z * axis.z);
  const double x = axis.x / length, y = axis.y / length, z = axis.z / length;
  const double c = std::cos(angle), s = std::sin(angle), k = 1.0 - c;
  glm::dmat4 m(1.0);
  m[0] = {x * x * k + c, y * x * k + z * s, x * z * k - y * s, 0.0};
  m[1] = {x * y * k - z * s, y * y * k + c, y * z * k + x * s, 0.0};
  m[2] = {x * z * k + y * s, y * z * k - x * s, z * z * k + c, 0.0};
  return m;
}

glm::dmat4 inverse_rotation(double angle, const glm::dvec3& axis) { return glm::transpose(rotation(angle, axis)); }

glm::dmat4 rotation_by_basis(double angle, const glm::dvec3& axis) {
  // Any `up` that is not along the axis serves: the coordinate axis that is farthest from it is taken.
  const glm::dvec3 a = glm::abs(axis);
  const glm::dvec3 up(a.x <= a.y && a.x <= a.z, a.y < a.x && a.y <= a.z, a.z < a.x && a.z < a.y);
  const glm::dmat4 basis = gzrender::x_wi(glm::dvec3(0), axis, up);
  return basis * rotation_z(angle) * glm::transpose(basis);
}

glm::dmat4 inverse_rotation_by_basis(double angle, const glm::dvec3& axis) {
  return glm::transpose(rotation_by_basis(angle, axis));
}

glm::dmat4 orbit_model(const glm::dvec3& p, double angle, const glm::dvec3& axis) {
  return translation(p) * rotation(angle, axis) * translation(-p);
}

glm::dmat4 inverse_orbit_model(const glm::dvec3& p, double angle, const glm::dvec3& axis) {
  return translation(p) * inverse_rotation(angle, axis) * translation(-p);
}

glm::dmat4 orbit_camera(const glm::dmat4& x_iw, const glm::dvec3& p, double angle, const glm::dvec3& axis) {
  return x_iw * inverse_orbit_model(p, angle, axis);
}

glm::dmat4 inverse_orbit_camera(const glm::dmat4& x_wi, const glm::dvec3& p, double angle, const glm::dvec3& axis) {
  return orbit_model(p, angle, axis) * x_wi;
}

}  // namespace plumbline::transforms

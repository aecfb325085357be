#include "transforms/look_at.h"

namespace plumbline::transforms {
namespace {

/// A camera space in world coordinates: orthonormal axes and the origin.
struct Axes {
  glm::dvec3 x, y, z, origin;
};

// Transform of a space, and its inverse, from its axes. Class notes (004) 3.3, item 8.
glm::dmat4 to_world(const Axes& a) {
  return {glm::dvec4(a.x, 0.0), glm::dvec4(a.y, 0.0), glm::dvec4(a.z, 0.0), glm::dvec4(a.origin, 1.0)};
}

glm::dmat4 from_world(const Axes& a) {
  glm::dmat4 m(1.0);
  for (int i = 0; i < 3; ++i) m[i] = {a.x[i], a.y[i], a.z[i], 0.0};
  m[3] = {-glm::dot(a.x, a.origin), -glm::dot(a.y, a.origin), -glm::dot(a.z, a.origin), 1.0};
  return m;
}

Axes glu_axes(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up) {
  const glm::dvec3 forward = glm::normalize(center - eye);
  const glm::dvec3 side = glm::normalize(glm::cross(forward, up));
  return {side, glm::cross(side, forward), -forward, eye};
}

Axes uvw_axes(const glm::dvec3& e, const glm::dvec3& g, const glm::dvec3& t) {
  const glm::dvec3 w = glm::normalize(g);
  const glm::dvec3 u = glm::normalize(glm::cross(t, w));
  return {u, glm::cross(w, u), w, e};
}

Axes gram_schmidt_axes(const glm::dvec3& c, const glm::dvec3& l, const glm::dvec3& up) {
  const glm::dvec3 z = glm::normalize(l - c);
  const glm::dvec3 y = glm::normalize(up - glm::dot(up, z) * z);
  return {glm::cross(y, z), y, z, c};
}

Axes centered_axes(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up) {
  const glm::dvec3 z = glm::normalize(eye - center);
  const glm::dvec3 x = glm::normalize(glm::cross(up, z));
  const glm::dvec3 y = glm::normalize(glm::cross(z, x));
  return {x, y, z, center};
}

}  // namespace

namespace gl {

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up) {
  return from_world(glu_axes(eye, center, up));
}
glm::dmat4 inverse_look_at(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up) {
  return to_world(glu_axes(eye, center, up));
}

}  // namespace gl

namespace gzrender {

glm::dmat4 m_cam(const glm::dvec3& e, const glm::dvec3& g, const glm::dvec3& t) {
  return from_world(uvw_axes(e, g, t));
}
glm::dmat4 inverse_m_cam(const glm::dvec3& e, const glm::dvec3& g, const glm::dvec3& t) {
  return to_world(uvw_axes(e, g, t));
}

glm::dmat4 x_iw(const glm::dvec3& c, const glm::dvec3& l, const glm::dvec3& up) {
  return from_world(gram_schmidt_axes(c, l, up));
}
glm::dmat4 x_wi(const glm::dvec3& c, const glm::dvec3& l, const glm::dvec3& up) {
  return to_world(gram_schmidt_axes(c, l, up));
}

}  // namespace gzrender

namespace tinyrenderer {

glm::dmat4 lookat(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up) {
  return from_world(centered_axes(eye, center, up));
}
glm::dmat4 inverse_lookat(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up) {
  return to_world(centered_axes(eye, center, up));
}

}  // namespace tinyrenderer

}  // namespace plumbline::transforms

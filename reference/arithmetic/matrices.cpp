#include "reference/arithmetic/matrices.h"

#include <cmath>

#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace plumbline::math {
namespace {

template <class... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <class... F>
Overloaded(F...) -> Overloaded<F...>;

// Distance of a near or far plane; games101 gives a z coordinate instead.
double distance_to(const Scene& scene, double near_or_far) {
  return scene.dialect == Dialect::games101 ? -near_or_far : near_or_far;
}

/// The projection by OpenGL's conventions: NDC z is -1 near and +1 far, rows from the bottom. A pinhole has no near and
/// far plane: its NDC z is 0 at the distance c and greater nearer.
glm::dmat4 opengl_projection(const Scene& scene) {
  return std::visit(
      Overloaded{[&](const Perspective& p) {
                   const double aspect = static_cast<double>(scene.frame.width) / scene.frame.height;
                   return glm::perspective(glm::radians(p.fov_y_degrees), aspect, distance_to(scene, p.near),
                                           distance_to(scene, p.far));
                 },
                 [&](const Orthographic& o) {
                   return glm::ortho(o.left, o.right, o.bottom, o.top, distance_to(scene, o.near),
                                     distance_to(scene, o.far));
                 },
                 [](const Frustum& f) { return glm::frustum(f.left, f.right, f.bottom, f.top, f.near, f.far); },
                 [](const ViewPlane& v) {
                   // Infinite pyramid from the view plane on, at distance d, where w is 1 by X_pi and d by OpenGL.
                   const double half = glm::radians(v.fov_degrees) / 2, d = std::cos(half) / std::sin(half);
                   return glm::infinitePerspective(2 * half, 1.0, d) / d;
                 },
                 [](const Pinhole& p) {
                   // At distance c, x and y keep their size, depth is 0 and w is 1; farther, depth is less.
                   glm::dmat4 m(1.0);
                   m[2][3] = -1 / p.c;
                   m[3][2] = p.c;
                   m[3][3] = 0;
                   return m;
                 }},
      scene.projection);
}

/// opengl_projection() with the dialect's sense of depth, row order and pixel centres.
glm::dmat4 dialect_projection(const Scene& scene) {
  const glm::dmat4 projection = opengl_projection(scene);
  const double half_x = 1.0 / scene.frame.width, half_y = 1.0 / scene.frame.height;  // half a pixel, in NDC
  const glm::dmat4 one(1.0);
  switch (scene.dialect) {
    case Dialect::gl: break;
    case Dialect::games101: return glm::scale(one, {1, 1, -1}) * projection;  // +1 near
    case Dialect::gzrender:                                                   // rows from the top, whole centres
      return glm::translate(one, {half_x, half_y, 0}) * glm::scale(one, {1, -1, 1}) * projection;
    case Dialect::tinyrenderer: return glm::translate(one, {half_x, half_y, 0}) * projection;  // whole centres
  }
  return projection;
}

/// dialect_projection() with the picture moved by the pass' shift: s pixels are 2 s / width in NDC.
glm::dmat4 projection_matrix(const Scene& scene) {
  glm::dmat4 m = dialect_projection(scene);
  const glm::dvec2 moved = 2.0 * scene.frame.pass.shift / glm::dvec2(scene.frame.width, scene.frame.height);
  for (int column = 0; column < 4; ++column) {
    m[column].x += moved.x * m[column].w;
    m[column].y += moved.y * m[column].w;
  }
  return m;
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
  const auto& [eye, center, up] = scene.camera;
  if (const auto* v = std::get_if<ViewPlane>(&scene.projection)) {
    // A left-handed view from the view plane's middle; the eye is d behind it; turned to look down -z.
    const double d = 1 / std::tan(glm::radians(v->fov_degrees) / 2);
    const glm::dmat4 turned = glm::lookAtLH(glm::dvec3(0), center - eye, up);
    return glm::scale(glm::dmat4(1.0), {1, 1, -1}) * glm::translate(glm::dmat4(1.0), {0, 0, d}) *
           glm::translate(turned, -eye);
  }
  if (const auto* p = std::get_if<Pinhole>(&scene.projection)) {
    // The eye is at distance c before the camera's center, and looks at it.
    const glm::dmat4 turned = glm::lookAt(glm::dvec3(0), center - eye, up);
    return glm::translate(glm::dmat4(1.0), {0, 0, -p->c}) * glm::translate(turned, -center);
  }
  return glm::lookAt(eye, center, up);
}

Matrices<double> double_matrices(const Scene& scene, const Draw& draw) {
  Matrices<double> m;
  m.model_view = view_matrix(scene);
  for (const Transform& transform : draw.transforms) m.model_view = times(m.model_view, transform);
  m.projection = projection_matrix(scene);
  m.normal = glm::transpose(glm::inverse(glm::dmat3(m.model_view)));
  const double near = draw.depth_range.near, far = draw.depth_range.far;  // GL 2.1, section 2.11.1
  m.win_scale = glm::dvec3(scene.frame.width, scene.frame.height, far - near) * 0.5;
  m.win_translate = glm::dvec3(scene.frame.width, scene.frame.height, far + near) * 0.5;
  return m;
}

Matrices<double> float_matrices(const Scene& scene, const Draw& draw) {
  Matrices<double> m = double_matrices(scene, draw);
  round_entries(m.model_view);
  round_entries(m.projection);
  round_entries(m.normal);
  m.win_scale = glm::dvec3(glm::vec3(m.win_scale));
  m.win_translate = glm::dvec3(glm::vec3(m.win_translate));
  return m;
}

std::optional<double> z_view_of_zero(const glm::dmat4& projection, Conventions::ClipDepth volume) {
  const glm::dvec4 z_row = glm::row(projection, 2), w_row = glm::row(projection, 3);
  const bool is_perspective = w_row.z != 0;
  const double z_ndc = is_perspective ? z_row.z / w_row.z : z_row.w / w_row.w;
  if (z_row.x != z_ndc * w_row.x || z_row.y != z_ndc * w_row.y || !std::isfinite(z_ndc)) return std::nullopt;
  return volume == Conventions::ClipDepth::zero_to_w ? z_ndc : 0.5 + 0.5 * z_ndc;
}

}  // namespace plumbline::math

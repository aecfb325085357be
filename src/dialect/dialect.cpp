#include "dialect/dialect.h"

#include <stdexcept>

#include "transforms/look_at.h"
#include "transforms/projection.h"
#include "transforms/transform.h"

namespace plumbline {

namespace {

constexpr double kRadians = 3.14159265358979323846 / 180.0;

template <class Kind>
const Kind& projection_of(const Scene& scene) {
  if (const Kind* kind = std::get_if<Kind>(&scene.projection)) return *kind;
  throw std::invalid_argument(scene.name + ": the projection is not one of the scene's dialect");
}

transforms::FieldOfView field_of_view(const Scene& scene, const Perspective& p) {
  return {p.fov_y_degrees * kRadians, static_cast<double>(scene.frame.width) / scene.frame.height};
}

// Window of whole pixel centres to GL's: x_gl = x + 1/2, which is 1/width in NDC, and w/width in clip space.
glm::dmat4 from_whole_centres(const FrameFormat& frame) {
  return transforms::translation({1.0 / frame.width, 1.0 / frame.height, 0});
}

double d_of(const Scene& scene) {
  return transforms::gzrender::d_of_fov(projection_of<ViewPlane>(scene).fov_degrees * kRadians);
}

// gzrender's camera space to eye space. It looks along +z from (0, 0, -d): z_eye = -(Z + d). This mirrors the
// left-handed space to a right-handed one.
glm::dmat4 eye_of_gzrender(double d) { return transforms::scaling({1, 1, -1}) * transforms::translation({0, 0, d}); }
glm::dmat4 inverse_eye_of_gzrender(double d) {
  return transforms::inverse_translation({0, 0, d}) * transforms::inverse_scaling({1, 1, -1});
}

// NDC's z in [0, 1) is the window's, so GL's is 2 z - 1: z_clip = 2 z - w. Rows are counted from the top: y is turned
// over. The outside of a mesh, counter-clockwise in GL, is mirrored by the left-handed world and turned over by the
// rows: its area in the window is positive, as in GL.
glm::dmat4 gzrender_projection(const Scene& scene) {
  const double d = d_of(scene);
  const glm::dmat4 z_and_rows =
      transforms::translation({0, 0, -1}) * transforms::scaling({1, -1, 2});  // in clip space, -1 is -w
  return from_whole_centres(scene.frame) * z_and_rows * transforms::gzrender::x_pi(d) * inverse_eye_of_gzrender(d);
}

// w = z is negative for what is seen: all four coordinates are negated, which is the same point. NDC's z is 1 near: in
// the window, greater is nearer.
glm::dmat4 games101_projection(const Scene& scene) {
  if (const auto* o = std::get_if<Orthographic>(&scene.projection)) {
    return transforms::games101::orthographic(o->left, o->right, o->bottom, o->top, o->near, o->far);
  }
  const auto& p = projection_of<Perspective>(scene);
  return -transforms::games101::perspective(field_of_view(scene, p), p.near, p.far);
}

// Camera space has its origin at the camera's center, and the eye at (0, 0, c). NDC's z is greater nearer, and so is
// the window's, (z + 1) / 2 as in GL.
glm::dmat4 tinyrenderer_projection(const Scene& scene) {
  const double c = projection_of<Pinhole>(scene).c;
  return from_whole_centres(scene.frame) * transforms::tinyrenderer::projection(c) * transforms::translation({0, 0, c});
}

glm::dmat4 gl_projection(const Scene& scene) {
  using namespace transforms::gl;
  if (const auto* f = std::get_if<Frustum>(&scene.projection)) {
    return frustum(f->left, f->right, f->bottom, f->top, f->near, f->far);
  }
  if (const auto* o = std::get_if<Orthographic>(&scene.projection)) {
    return orthographic(o->left, o->right, o->bottom, o->top, o->near, o->far);
  }
  const auto& p = projection_of<Perspective>(scene);
  return perspective(field_of_view(scene, p), p.near, p.far);
}

}  // namespace

glm::dmat4 view_matrix(const Scene& scene) {
  const auto& [eye, center, up] = scene.camera;
  switch (scene.dialect) {
    case Dialect::gl:
    case Dialect::games101: return transforms::gl::look_at(eye, center, up);
    case Dialect::gzrender: return eye_of_gzrender(d_of(scene)) * transforms::gzrender::x_iw(eye, center, up);
    case Dialect::tinyrenderer:
      return transforms::translation({0, 0, -projection_of<Pinhole>(scene).c}) *
             transforms::tinyrenderer::lookat(eye, center, up);
  }
  throw std::invalid_argument(scene.name + ": no such dialect");
}

namespace {

glm::dmat4 unshifted_projection(const Scene& scene) {
  switch (scene.dialect) {
    case Dialect::gl: return gl_projection(scene);
    case Dialect::games101: return games101_projection(scene);
    case Dialect::gzrender: return gzrender_projection(scene);
    case Dialect::tinyrenderer: return tinyrenderer_projection(scene);
  }
  throw std::invalid_argument(scene.name + ": no such dialect");
}

}  // namespace

// The shift is applied in clip space, so that the view volume stays the frame's.
glm::dmat4 projection_matrix(const Scene& scene) {
  const glm::dvec2 shift = scene.frame.pass.shift, pixel(2.0 / scene.frame.width, 2.0 / scene.frame.height);
  if (shift == glm::dvec2(0)) return unshifted_projection(scene);
  return transforms::translation({shift.x * pixel.x, shift.y * pixel.y, 0}) * unshifted_projection(scene);
}

}  // namespace plumbline

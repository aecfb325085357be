// Projections: matrices from camera space to clip space, where division by w gives NDC, and their inverses. Angles in
// radians. An empty volume or a distance of 0 gives infinite or NaN entries.
#pragma once

#include <glm/glm.hpp>

namespace plumbline::transforms {

/// The visible rectangle of the near plane, in camera space.
struct NearPlane {
  double left, right, bottom, top;
};

/// A view that is symmetric about the z-axis: its full angle in y, (0, pi), and width / height.
struct FieldOfView {
  double fov_y, aspect;
};

/// GAMES101 (001) "Perspective Projection": tan(fovY/2) = t/|n|, aspect = r/t, l = -r, b = -t; n of either sign.
NearPlane near_plane(const FieldOfView& view, double n);
/// The inverse of near_plane(). The plane must be symmetric: only `right` and `top` are read.
FieldOfView field_of_view(const NearPlane& plane, double n);

/// Right-handed, the eye at the origin looking down -z. 0 < n < f are distances. NDC is left-handed, z in [-1, 1], -1
/// near.
namespace gl {

/// glFrustum, glOrtho (GL 2.1 spec 2.11.2) and gluPerspective, in their parameters' order. glOrtho's n and f may have
/// any sign.
glm::dmat4 frustum(double l, double r, double b, double t, double n, double f);
glm::dmat4 inverse_frustum(double l, double r, double b, double t, double n, double f);
glm::dmat4 orthographic(double l, double r, double b, double t, double n, double f);
glm::dmat4 inverse_orthographic(double l, double r, double b, double t, double n, double f);
glm::dmat4 perspective(const FieldOfView& view, double n, double f);
glm::dmat4 inverse_perspective(const FieldOfView& view, double n, double f);

}  // namespace gl

/// Left-handed, looking along +z; the eye at (0, 0, -d), the view plane z = 0 in front of it. NDC is left-handed too, z
/// in [0, 1): 0 on the view plane, 1 at infinity; -d < z < 0 projects to NDC z < 0.
namespace gzrender {

/// Distance d of the eye from the view plane, and back: 1/d = tan(FOV/2), for x in [-1, 1] on the view plane. Class
/// notes (004) 3.2.
double d_of_fov(double fov);
double fov_of_d(double d);

/// X_pi, class notes (004) 3.2; M_perspective, GzRender (000): (X, Y, Z, 1) to (X, Y, Z/d, Z/d + 1).
glm::dmat4 x_pi(double d);
glm::dmat4 inverse_x_pi(double d);

}  // namespace gzrender

/// Right-handed, the eye at the origin looking down -z; n and f are coordinates, f < n < 0. NDC z in [-1, 1], +1 near.
namespace games101 {

/// GAMES101 (001) "What's after MVP?": cuboid to canonical cube, by a translation and a scaling.
glm::dmat4 orthographic(double l, double r, double b, double t, double n, double f);
glm::dmat4 inverse_orthographic(double l, double r, double b, double t, double n, double f);

/// Frustum to cuboid: keeps points on the near plane, z = n and z = f. w = z, negative for visible points.
glm::dmat4 persp_to_ortho(double n, double f);
glm::dmat4 inverse_persp_to_ortho(double n, double f);

/// Frustum to canonical cube: orthographic() * persp_to_ortho(), with l, r, b, t of near_plane(); w = z as there.
glm::dmat4 perspective(const FieldOfView& view, double n, double f);
glm::dmat4 inverse_perspective(const FieldOfView& view, double n, double f);

}  // namespace games101

/// Right-handed, looking down -z; the eye at (0, 0, c), the view plane z = 0. NDC z = z/(1 - z/c): 0 on the view plane,
/// -c at infinity, unbounded towards the eye; greater is nearer.
namespace tinyrenderer {

/// The projection that goes with `lookat`, TinyRenderer (002): w = 1 - z/c.
glm::dmat4 projection(double c);
glm::dmat4 inverse_projection(double c);

}  // namespace tinyrenderer

}  // namespace plumbline::transforms

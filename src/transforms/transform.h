// Translation, scaling, rotations and orbits, as matrices in double that act on column vectors: p' = M p. Angles are in
// radians, counter-clockwise as seen from the axis' tip in right-handed coordinates (clockwise in left-handed ones, by
// the same numbers). Each inverse has its own formula; none is an elimination.
#pragma once

#include <glm/glm.hpp>

namespace plumbline::transforms {

/// T, class notes (004) 3.1. T^-1(t) = T(-t).
glm::dmat4 translation(const glm::dvec3& t);
glm::dmat4 inverse_translation(const glm::dvec3& t);

/// S, class notes (004) 3.1. S^-1(s) = S(1/s): infinite where a component is 0.
glm::dmat4 scaling(const glm::dvec3& s);
glm::dmat4 inverse_scaling(const glm::dvec3& s);

/// R_x, R_y, R_z: class notes (004) 3.1, GzRender (000) "Model Space -> World Space". R^-1 = R^T.
glm::dmat4 rotation_x(double angle);
glm::dmat4 rotation_y(double angle);
glm::dmat4 rotation_z(double angle);
glm::dmat4 inverse_rotation_x(double angle);
glm::dmat4 inverse_rotation_y(double angle);
glm::dmat4 inverse_rotation_z(double angle);

/// Rotation about an axis through the origin, of any length but 0 (which gives NaN). Rodrigues: R = c I + (1 - c) a a^T
/// + s [a]x, a being the unit axis: the matrix of glRotate (GL 2.1 spec 2.11.2). R^-1 = R^T.
glm::dmat4 rotation(double angle, const glm::dvec3& axis);
glm::dmat4 inverse_rotation(double angle, const glm::dvec3& axis);

/// rotation() by class notes (004) 3.3, item 8: into a space whose Z is the axis, a rotation about Z there, and back.
glm::dmat4 rotation_by_basis(double angle, const glm::dvec3& axis);
glm::dmat4 inverse_rotation_by_basis(double angle, const glm::dvec3& axis);

/// Turns a model about the point `p`, in the space in which the matrix acts: T(p) R T(-p). Class notes (004) 3.3,
/// item 9.
glm::dmat4 orbit_model(const glm::dvec3& p, double angle, const glm::dvec3& axis);
glm::dmat4 inverse_orbit_model(const glm::dvec3& p, double angle, const glm::dvec3& axis);

/// Turns a camera about the point `p`; point and axis are in world space, and the camera keeps its view of the point.
/// `x_iw` and the result, x_iw O^-1, are world to camera; O is the orbit of a model. The inverse maps `x_wi`, camera to
/// world, to O x_wi. Class notes (004) 3.3, item 9.
glm::dmat4 orbit_camera(const glm::dmat4& x_iw, const glm::dvec3& p, double angle, const glm::dvec3& axis);
glm::dmat4 inverse_orbit_camera(const glm::dmat4& x_wi, const glm::dvec3& p, double angle, const glm::dvec3& axis);

}  // namespace plumbline::transforms

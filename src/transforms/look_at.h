// View matrices (world to camera space) by four constructions, and their inverses. Each is a rotation and a translation
// and does not mirror: a left-handed camera space belongs to a left-handed world. For one eye and centre, GL's x and z
// axes are opposite to the left-handed cameras'. Entries are NaN where the view direction is along `up` or has length
// 0.
#pragma once

#include <glm/glm.hpp>

namespace plumbline::transforms {

namespace gl {

/// gluLookAt: the eye at the origin, x to the right, y up, looking down -z; right-handed.
glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up);
glm::dmat4 inverse_look_at(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up);

}  // namespace gl

namespace gzrender {

/// M_cam, GzRender (000) "World Space -> Camera Space": `e` at the origin, looking along the gaze `g`, which becomes
/// +z, x to the right; left-handed. w = g/|g|, u = t x w/|t x w|, v = w x u (the notes' "v = w x v" is a slip), t being
/// up.
glm::dmat4 m_cam(const glm::dvec3& e, const glm::dvec3& g, const glm::dvec3& t);
glm::dmat4 inverse_m_cam(const glm::dvec3& e, const glm::dvec3& g, const glm::dvec3& t);

/// X_iw and its inverse X_wi, class notes (004) 3.3: `c` at the origin, looking along +z at `l`; left-handed. Z =
/// cl/|cl|, Y is the part of `up` at right angles to Z, normalised (Gram-Schmidt), X = Y x Z. The same matrix as
/// m_cam(c, l - c, up). With x_pi, whose eye is at (0, 0, -d), the eye is d behind c.
glm::dmat4 x_iw(const glm::dvec3& c, const glm::dvec3& l, const glm::dvec3& up);
glm::dmat4 x_wi(const glm::dvec3& c, const glm::dvec3& l, const glm::dvec3& up);

}  // namespace gzrender

namespace tinyrenderer {

/// `lookat`, TinyRenderer (002) "LookAt Method": gluLookAt's axes, but with `center` at the origin; the eye is at
/// (0, 0, |eye - center|). Right-handed, looking down -z.
glm::dmat4 lookat(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up);
glm::dmat4 inverse_lookat(const glm::dvec3& eye, const glm::dvec3& center, const glm::dvec3& up);

}  // namespace tinyrenderer

}  // namespace plumbline::transforms

// Curved and closed meshes made by formula: the same numbers on every machine whose sine and cosine agree.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline {

/// [-1,1]^3: 24 vertices, so that each face has its own normals, and texture coordinates from (0,0) to (1,1).
Mesh make_cube();

/// The unit sphere from an icosahedron, each triangle cut into four `subdivisions` times: 20 * 4^n triangles of nearly
/// one size. A normal is its position. Each vertex exists once: the mesh is closed. subdivisions: [0, 8].
Mesh make_icosphere(int subdivisions);

struct TorusKnot {
  int p = 2;          ///< turns around the axis (z)
  int q = 3;          ///< turns through the hole; p and q have no common divisor: the knot is one curve
  int segments = 0;   ///< along the knot, >= 3
  int sides = 0;      ///< around the tube, >= 3
  double tube = 0.1;  ///< the tube's radius
};
/// A tube along the (p, q) torus knot on a torus of radii 0.6 and 0.25. Each vertex exists once: the mesh is closed.
Mesh make_torus_knot(const TorusKnot& knot);

/// The profile (radius, y) of a chain of cubic Bézier curves, each cut into `steps` straight pieces.
/// control: 3 n + 1 points, neighbouring curves sharing one.
std::vector<glm::dvec2> bezier_profile(std::span<const glm::dvec2> control, int steps);

/// Surface of revolution of a profile (radius, y) about the y axis, such as a teapot's body: counter-clockwise from
/// outside where the profile goes up. An end of radius 0 is the tip of a fan and closes the mesh there. Normals are
/// area-weighted. Each vertex exists once. slices >= 3; two points or more, radii above 0 between the ends.
Mesh make_revolution(std::span<const glm::dvec2> profile, int slices);

}  // namespace plumbline

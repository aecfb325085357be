// Projection of a scene to homogeneous window coordinates, and bounds on displacements by float arithmetic.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <glm/glm.hpp>

#include "reference/arithmetic/projected.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Projection of the scene for a renderer of these conventions. `scene`: already altered by them
/// (capture/by_conventions.h).
Projected project(const Scene& scene, const Conventions& conventions = {});

/// Adds the corners of a draw.
void add_corners(const Scene& scene, const Draw& draw, Projected& out);

/// Error by float arithmetic of the coordinates (X, Y, z_clip, W) of the triangle's point at the ray d, which lies in
/// the triangle. (Derived in project.cpp.)
glm::dvec4 clip_error(const Projected& scene, const Triangle& triangle, glm::dvec3 d);
/// Displacement of the triangle's outline near the window point d, per axis [pixels]. `error`: clip_error() there; `w`:
/// the triangle's clip w there.
glm::dvec2 float_displacement(const Projected& scene, const glm::dvec4& error, glm::dvec3 d, double w);
/// Displacement of a corner by float arithmetic, per axis [pixels]; infinite where the corner is beside or behind the
/// eye.
glm::dvec2 corner_displacement(const Projected& scene, const Corner& corner);
/// Grid points to which a corner may be snapped, from the frame's lower left corner [steps of the grid]; none: unknown.
struct GridPoints {
  std::array<glm::dvec2, 4> at;
  std::size_t count = 0;
};
GridPoints grid_points(const Projected& scene, const Corner& corner);
/// Largest displacement of a coordinate by snapping [pixels]: half a step of the grid by rounding to nearest, else a
/// step.
double snapping_step(const Conventions& conventions);
/// The corner on the grid; nullopt: it may be snapped to several grid points.
std::optional<Corner> on_grid(const Projected& scene, const Corner& corner);

/// Largest displacement of the triangle's outline at the ray d [pixels]: by snapping, plus the length of the sum of
/// float_displacement() (by the largest error of any of the triangle's points) and Triangle::stepped.
double displacement(const Projected& scene, const Triangle& triangle, glm::dvec3 d, double w);

/// A piece of a segment a + t (b - a), t in [from, to]; empty if from > to.
struct Piece {
  double from = 0, to = 1;
};
/// The piece of the edge from corner j to corner k that is between the near and far planes and within `margin` pixels
/// of the window, widened by the error of float arithmetic. Under depth clamp, as piece_in_window().
Piece visible_piece(const Projected& scene, const Corner& j, const Corner& k, double margin);
/// The piece that is in front of the eye, at any depth, and within `margin` pixels of the window, widened alike.
Piece piece_in_window(const Projected& scene, const Corner& j, const Corner& k, double margin);

}  // namespace plumbline::math

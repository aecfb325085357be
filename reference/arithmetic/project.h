// A scene into homogeneous window coordinates, and how far float arithmetic may move what is drawn there.
#pragma once

#include <glm/glm.hpp>

#include "reference/arithmetic/projected.h"
#include "scene/scene.h"

namespace plumbline::math {

/// A renderer's view of the scene, by its conventions: `scene` is as they alter it (capture/by_conventions.h).
Projected project(const Scene& scene, const Conventions& conventions = {});

/// How far float arithmetic may move the triangle's outline near the window point d, per axis in pixels; `w` is its
/// w there. (Derived in project.cpp.)
glm::dvec2 float_displacement(const Projected& scene, const Triangle& triangle, glm::dvec3 d, double w);
/// How far float arithmetic may move a corner ahead of the eye, per axis in pixels; infinite beside the eye.
glm::dvec2 corner_displacement(const Projected& scene, const Corner& corner);
/// The length of float_displacement() in pixels, with what snapping adds: delta.
double displacement(const Projected& scene, const Triangle& triangle, glm::dvec3 d, double w);

/// A piece [from, to] of a segment a + t (b - a), t in [0,1]; empty if from > to.
struct Piece {
  double from = 0, to = 1;
};
/// The part of the edge from corner j to corner k that lies between the near and far planes, with what float arithmetic
/// may add to it, and within `margin` pixels of the window.
Piece visible_piece(const Projected& scene, const Corner& j, const Corner& k, double margin);
/// The part that lies before the eye, however deep, and within `margin` pixels of the window.
Piece piece_in_window(const Projected& scene, const Corner& j, const Corner& k, double margin);

}  // namespace plumbline::math

// Bounds on the error of a vertex' colour, position, normal and lights in float arithmetic.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/stages.h"
#include "reference/arithmetic/light.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Error of each light's position or direction in eye space [length of the error vector], in the order of the lights.
std::vector<double> light_errors(const Scene& scene, const glm::dmat4& view);

/// Error, per channel, of the colour of vertex number `vertex` of the draw's mesh. `m` and the draw's lights are
/// unrounded, `light_errors` the lights' errors. At most 1, as colours are clamped.
double color_error(const LitDraw& lit, const Matrices<double>& m, std::span<const double> light_errors,
                   std::uint32_t vertex, LitPart part = {});

/// A vector in eye space, and a bound on the length of its error.
struct BoundedVector {
  glm::dvec3 v;
  double error;
};

/// `a` at unit length; normalising adds 4 u. Where |a| <= 2 * error, no direction is certain: +z with an error of 2.
BoundedVector unit(const BoundedVector& a);
/// Position and normal of the mesh's vertex number `vertex`, with the errors of float arithmetic.
BoundedVector eye_position(const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex);
BoundedVector eye_normal(const Draw& draw, const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex);

}  // namespace plumbline::math

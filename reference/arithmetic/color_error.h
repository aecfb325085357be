// How far a float evaluation of a vertex' colour may be from the one in double.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/stages.h"
#include "reference/arithmetic/light.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Error of each light's place or direction in eye space, in length.
std::vector<double> light_errors(const Scene& scene, const glm::dmat4& view);

/// Per channel, for vertex number `vertex` of the draw's mesh; `m` and `lights` unrounded, the latter's errors
/// `light_errors`. At most 1: colours are clamped.
double color_error(const Scene& scene, const Draw& draw, const Matrices<double>& m, Lights lights,
                   std::span<const double> light_errors, std::uint32_t vertex, LitPart part = {});

/// A vector of eye space and how far it may be off, in length.
struct Known {
  glm::dvec3 v;
  double error;
};

/// Brought to unit length: 4 u for that. Without a direction to rely on it may be anywhere: an error of 2.
Known unit(const Known& a);
/// The position and the normal of the mesh's vertex number `vertex`, float's errors in them.
Known eye_position(const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex);
Known eye_normal(const Draw& draw, const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex);

}  // namespace plumbline::math

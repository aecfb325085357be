// How far a float evaluation of a vertex' colour may be from the one in double.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture/stages.h"
#include "reference/arithmetic/light.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Per channel, for vertex number `vertex` of the draw's mesh; `m` and `view` unrounded. At most 1: colours are
/// clamped. Infinite where a cone's edge may be on either side of the vertex.
double color_error(const Scene& scene, const Draw& draw, const Matrices<double>& m, const glm::dmat4& view,
                   std::uint32_t vertex, LitPart part = {});

/// A vector of eye space and how far it may be off, in length.
struct Known {
  glm::dvec3 v;
  double error;
};

/// What color_error is of a vertex, of any point that is lit: per channel, from the errors of its position, its normal,
/// which is as long as the light equation has it, and its material's colours, if these follow the vertex colour.
double light_error(const Scene& scene, const DoubleMaterial& material, const glm::dmat4& view, const Known& p_eye,
                   const Known& n_eye, double of_color);

/// Brought to unit length: 4 u for that. Without a direction to rely on it may be anywhere: an error of 2.
Known unit(const Known& a);
/// The position and the normal of the mesh's vertex number `vertex`, float's errors in them.
Known eye_position(const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex);
Known eye_normal(const Draw& draw, const Mesh& mesh, const Matrices<double>& m, std::uint32_t vertex);

}  // namespace plumbline::math

// Bounds on the error of stage 2's light equation in float arithmetic.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "capture/stages.h"
#include "reference/arithmetic/light.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Bounds on the effect of rounding and of the inputs' errors on a lit colour, per channel. A channel whose specular
/// term alone is certainly 1 or more is clamped to 1: its bounds are those of 1, however far off the power is.
struct LightBounds {
  /// Rounding error of the light equation in float, in units of 16 u: |emission| + |ambient| |global ambient| and the
  /// sum over the lights of |ambient| + k |n| |diffuse| + (k + s e) |specular|, at least 1 (the clamped result). k:
  /// condition of the direction to the light, 1 for a directional light, 1 + (|light| + |p_eye|) / |light - p_eye| for
  /// a point light. |n|: the normal's length, at least 1. s: shininess, by which a power multiplies the error e of its
  /// base (for cosines above 1, by s n^(s-1)). e: |n| k (1 + 1 / |L + E|) of the half vector (|L + E|: its length
  /// before it is normalised), for a local viewer |n| / |L + E| more; 4 |n|^2 (k + 1) of 2 (N.L) (N.E) - L.E.
  /// Attenuation adds 2 k, a cone the slope of its power times k + 1. Infinite where the direction to a light or to a
  /// local viewer is lost in rounding.
  Vec3<double> magnitude{0};
  /// Light that rounding may add or remove: the specular terms of lights whose N.L is within rounding of 0; all of a
  /// light whose cone ends within rounding; under Sides::flip, of a light where N.E is within rounding of 0.
  Vec3<double> jump{0};
  /// Error that the inputs' errors (LightInputs) cause; not part of `magnitude`.
  Vec3<double> inherited{0};
  /// Channels whose specular term is 0 while its power may overflow float: a renderer that does not limit the power
  /// computes 0 times infinity.
  glm::bvec3 overflows{false};
};
/// Errors of the light equation's inputs: of position and normal [length], of material colours that follow the vertex
/// colour, and of each light's position or direction [length]; a light without an entry has none.
struct LightInputs {
  double p_eye = 0, n_eye = 0, color = 0;
  std::span<const double> lights{};
};
/// Bounds at a vertex. `material`: the draw's at the vertex (light.h). `lights`: the recorded lights; the scene's own
/// stand in for those that are not recorded.
LightBounds light_bounds(const Scene& scene, const DoubleMaterial& material, const Vertex<double>& vertex,
                         const LightInputs& errors = {}, Lights lights = {});

/// Error of the light equation in float, largest over the channels, at most 1, as colours are clamped: 16 u of
/// `magnitude`, plus `inherited`, plus `jump`.
double light_error(const Scene& scene, const DoubleMaterial& material, const Vertex<double>& vertex,
                   const LightInputs& errors, Lights lights);

}  // namespace plumbline::math

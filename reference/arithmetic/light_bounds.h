// Error of stage 2's light equation in float arithmetic.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "capture/stages.h"
#include "reference/arithmetic/light.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Bounds of what rounding does to a lit colour.
struct LightBounds {
  /// Per channel, in units of u, how it may differ in float from the spec's equation in double: the sum over the lights
  /// of |ambient| + k |n| |diffuse| + (k + s e) |specular|, at least 1 (the clamped result).
  /// s: shininess, by which a power multiplies its argument's error (of cosines above 1, by s n^(s-1)); e: that error,
  /// |n| k (1 + 1 / |L + E|) of the half vector (|L + E|: its length before it is normalised; 1 / |L + E| more of a
  /// local viewer), 4 |n|^2 (k + 1) of 2 (N.L) (N.E) - L.E; k: of a point light, (|light| + |p_eye|) / |light - p_eye|
  /// + 1. Attenuation has 2 k, a cone the slope of its power times k + 1. Infinite where the light lies at the vertex and
  /// has no direction.
  Vec3<double> magnitude{0};
  /// Per channel, the light that rounding may add or take away: the specular terms of lights whose N.L is within
  /// rounding of 0; all of a light whose cone ends within rounding; in GzRender's rule, where N.E is.
  Vec3<double> jump{0};
  /// Per channel, the error that the inputs' errors (LightInputs) cause; `magnitude` does not contain it.
  Vec3<double> inherited{0};
  /// Per channel: the specular term is 0 while its power may overflow float. A renderer that does not limit the power
  /// then computes 0 times infinity.
  glm::bvec3 overflows{false};
};
/// How far position and normal (in length), the material's colours that follow the vertex', and each light's place or
/// direction (in length; none: 0) may be off.
struct LightInputs {
  double p_eye = 0, n_eye = 0, color = 0;
  std::span<const double> lights{};
};
/// `material`: the draw's at the vertex (light.h). `lights`: recorded ones; where there are none, the scene's.
LightBounds light_bounds(const Scene& scene, const DoubleMaterial& material, const Vertex<double>& vertex,
                         const LightInputs& errors = {}, Lights lights = {});

/// Per channel, at most 1, for colours are clamped: how far a light equation in float may be from the one in double.
/// 16 u of the magnitude, what the inputs' errors come to, and the light that they may add or take away.
double light_error(const Scene& scene, const DoubleMaterial& material, const Vertex<double>& vertex,
                   const LightInputs& errors, Lights lights);

}  // namespace plumbline::math

// Fog in double, by the OpenGL 2.1 specification, section 3.10.
#pragma once

#include <glm/glm.hpp>

#include "reference/arithmetic/bounded.h"
#include "scene/scene.h"

namespace plumbline::math {

/// f, clamped to [0,1], at the distance c = |z_eye|, by a renderer that has z_eye to a bound. Its error, of density d:
/// d f |dz| (exp), d (2 d c + d |dz|) f |dz| (exp2), f at the nearest distance there may be, |dz| / |end - start|
/// (linear); and its argument's roundings, which the exponential makes absolute: x exp(-x) <= 1/e.
Bounded fog_factor(const Fog& fog, Bounded z_eye, const Roundings& roundings);

/// f C + (1 - f) C_fog; alpha as it is.
glm::dvec4 fogged(const Fog& fog, const glm::dvec4& color, double z_eye);

}  // namespace plumbline::math

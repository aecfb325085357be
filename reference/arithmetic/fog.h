// Fog in double, by the OpenGL 2.1 specification, section 3.10.
#pragma once

#include <glm/glm.hpp>

#include "reference/arithmetic/bounded.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Fog factor f, in [0,1], at the distance c = |z_eye|, with its error where z_eye has an error of dz. The error, for
/// density d, is |dz| / |end - start| (linear), d f dz (exp) or d (2 d c + d dz) f dz (exp2), f at the least distance
/// possible; plus the roundings of the exponential's argument, an absolute error because x exp(-x) <= 1/e.
Bounded fog_factor(const Fog& fog, Bounded z_eye, const Roundings& roundings);

/// The colour in fog: rgb is f C + (1 - f) C_fog, alpha unchanged.
glm::dvec4 fogged(const Fog& fog, const glm::dvec4& color, double z_eye);

}  // namespace plumbline::math

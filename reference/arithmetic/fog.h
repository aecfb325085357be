// Fog in double, by the OpenGL 2.1 specification, section 3.10.
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline::math {

/// f, clamped to [0,1], at the distance c = |z_eye|.
double fog_factor(const Fog& fog, double z_eye);

/// How far f in float may be from it, where z_eye may be off by `error`: by the largest slope in between, and 16 u of
/// f's argument and of 1 for rounding.
double fog_factor_error(const Fog& fog, double z_eye, double error);

/// f C + (1 - f) C_fog; alpha as it is.
glm::dvec4 fogged(const Fog& fog, const glm::dvec4& color, double z_eye);

}  // namespace plumbline::math

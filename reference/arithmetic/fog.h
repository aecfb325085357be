// Fog in double, by the OpenGL 2.1 specification, section 3.10.
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "reference/arithmetic/bounded.h"
#include "scene/scene.h"

namespace plumbline::math {

/// Fog factor f, in [0,1], at the distance c = |distance| [eye units]: z_eye, or the length of p_eye. Error of f for a
/// distance that errs by dc, at the density d: dc / |end - start| (linear), d f dc (exp) or d (2 d c + d dc) f dc
/// (exp2), f at the least distance possible; plus the roundings of the exponential's argument, an absolute error
/// because x exp(-x) <= 1/e.
inline Bounded fog_factor(const Fog& fog, Bounded distance, const Roundings& roundings) {
  const double c = std::abs(distance.value), dc = distance.error, density = fog.density, x = density * c;
  const double start = fog.start, end = fog.end, range = std::abs(end - start);
  switch (fog.mode) {
    case Fog::Mode::linear:
      return {std::clamp((end - c) / (end - start), 0.0, 1.0), dc / range + roundings((std::abs(end) + c) / range)};
    case Fog::Mode::exp: {
      const double f = std::exp(-std::max(x - density * dc, 0.0));
      return {std::exp(-x), f * density * dc + roundings(f * (1 + x))};
    }
    case Fog::Mode::exp2: {
      const double near = std::max(x - density * dc, 0.0), f = std::exp(-near * near);
      return {std::exp(-x * x), f * (2 * x + density * dc) * density * dc + roundings(f * (1 + 2 * x * x))};
    }
  }
  return {1, 0};
}

/// The colour in fog: rgb is f C + (1 - f) C_fog, alpha unchanged.
inline glm::dvec4 fogged(const Fog& fog, const glm::dvec4& color, double z_eye) {
  const double f = fog_factor(fog, {z_eye, 0}, {0}).value;
  return {f * glm::dvec3(color) + (1 - f) * glm::dvec3(fog.color), color.a};
}

}  // namespace plumbline::math

#include "reference/arithmetic/fog.h"

#include <algorithm>
#include <cmath>

namespace plumbline::math {

double fog_factor(const Fog& fog, double z_eye) {
  const double c = std::abs(z_eye), density = fog.density, start = fog.start, end = fog.end;
  double f = 1;
  switch (fog.mode) {
    case Fog::Mode::linear: f = (end - c) / (end - start); break;
    case Fog::Mode::exp: f = std::exp(-density * c); break;
    case Fog::Mode::exp2: f = std::exp(-(density * c) * (density * c)); break;
  }
  return std::clamp(f, 0.0, 1.0);
}

double fog_factor_error(const Fog& fog, double z_eye, double error) {
  if (!std::isfinite(error)) return 1;
  constexpr double kRounding = 16.0 / (1 << 24);
  const double c = std::abs(z_eye), density = fog.density, start = fog.start, end = fog.end;
  const double nearest = density * std::max(c - error, 0.0), farthest = density * (c + error);
  double slope = 0, argument = 0;  // of f over the distance; its argument's size
  switch (fog.mode) {
    case Fog::Mode::linear:
      slope = 1 / std::abs(end - start);
      argument = (std::abs(end) + c) * slope;
      break;
    case Fog::Mode::exp: slope = density * std::exp(-nearest); break;  // x exp(-x) < 1
    case Fog::Mode::exp2: slope = 2 * density * farthest * std::exp(-nearest * nearest); break;
  }
  return std::min(1.0, slope * error + kRounding * (1 + argument));
}

glm::dvec4 fogged(const Fog& fog, const glm::dvec4& color, double z_eye) {
  const double f = fog_factor(fog, z_eye);
  return {f * glm::dvec3(color) + (1 - f) * glm::dvec3(fog.color), color.a};
}

}  // namespace plumbline::math

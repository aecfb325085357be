// Fog (OpenGL 2.1 spec 3.10), the last of stage 9.
#pragma once

#include "kernels/attributes.h"
#include "kernels/math.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// f, [0,1]: how much of the fragment's own colour is left at the distance c = |z_eye|, as the specification allows for
/// the distance from the eye. In double, rounded once.
template <class R>
R fog_factor(const Fog& fog, R z_eye) {
  using W = Wide<R>;
  constexpr double kLog2OfE = 1.4426950408889634;
  const W z = to_wide(z_eye), c = select(z < 0.0, -z, z);
  const W x = c * static_cast<double>(fog.density);
  switch (fog.mode) {
    case Fog::Mode::linear: return to_float(clamp01((W(fog.end) - c) / (W(fog.end) - W(fog.start))));
    case Fog::Mode::exp: return to_float(exp2_of(-x * kLog2OfE));
    case Fog::Mode::exp2: return to_float(exp2_of(-(x * x) * kLog2OfE));
  }
  return R(1);
}

/// f color + (1 - f) fog's; alpha as it is.
template <class R>
Color<R> fogged(const Fog& fog, const Color<R>& color, R z_eye) {
  const R f = fog_factor<R>(fog, z_eye), rest = R(1) - f;
  const auto mixed = [&](R of_fragment, float of_fog) { return f * of_fragment + rest * R(of_fog); };
  return {mixed(color.r, fog.color.r), mixed(color.g, fog.color.g), mixed(color.b, fog.color.b), color.a};
}

}  // namespace plumbline::pipeline

// Stage 11: the fragment's colour in the frame's format.
#pragma once

#include "pipeline/attributes.h"

namespace plumbline::pipeline {

/// `scale` 255, 4095: rgba8, rgba12, clamped to [0,1] and rounded to the nearest code, half to even (GL 2.1 spec
/// 2.14.9), which a float holds exactly. `scale` 0: float, as it is.
template <class R>
Color<R> merge(const Color<R>& color, float scale) {
  if (scale == 0.0f) return color;
  const auto code = [&](R value) { return round_even(clamp01(value) * scale); };
  return {code(color.r), code(color.g), code(color.b), code(color.a)};
}

}  // namespace plumbline::pipeline

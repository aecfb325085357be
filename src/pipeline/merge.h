// Stage 11: the fragment's colour, blended or combined with the frame's, in the frame's format.
#pragma once

#include "pipeline/attributes.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// `scale` 255, 4095, 65535: rgba8, rgba12, rgba16. Clamped to [0,1], times the scale, and rounded to the nearest code,
/// half to even (GL 2.1 spec 2.14.9), which a float holds exactly. The product is a float's of up to 12 bits: a colour
/// within 2^-25 of half way between two codes may go to either. Of 16 bits it is exact. `scale` 0: float, as it is.
template <class R>
Color<R> merge(const Color<R>& color, float scale) {
  if (scale == 0.0f) return color;
  if (scale > 4095.0f) {
    const auto wide_code = [&](R value) { return to_float(round_even(to_wide(clamp01(value)) * Wide<R>(scale))); };
    return {wide_code(color.r), wide_code(color.g), wide_code(color.b), wide_code(color.a)};
  }
  const auto code = [&](R value) { return round_even(clamp01(value) * scale); };
  return {code(color.r), code(color.g), code(color.b), code(color.a)};
}

/// A blend factor for a channel, times `unit`, so that those of the frame's colour are its codes and rounded nowhere.
/// `source` in [0,1] and `stored` in codes, or both as they are, and unit 1.
template <class W>
W blend_factor(BlendFactor factor, int channel, const W (&source)[4], const W (&stored)[4], const glm::vec4& constant,
               double unit) {
  switch (factor) {
    case BlendFactor::zero: return W(0);
    case BlendFactor::one: return W(unit);
    case BlendFactor::source_color: return source[channel] * unit;
    case BlendFactor::one_minus_source_color: return unit - source[channel] * unit;
    case BlendFactor::destination_color: return stored[channel];
    case BlendFactor::one_minus_destination_color: return unit - stored[channel];
    case BlendFactor::source_alpha: return source[3] * unit;
    case BlendFactor::one_minus_source_alpha: return unit - source[3] * unit;
    case BlendFactor::destination_alpha: return stored[3];
    case BlendFactor::one_minus_destination_alpha: return unit - stored[3];
    case BlendFactor::constant_color: return W(constant[channel] * unit);
    case BlendFactor::one_minus_constant_color: return W(unit - constant[channel] * unit);
    case BlendFactor::constant_alpha: return W(constant[3] * unit);
    case BlendFactor::one_minus_constant_alpha: return W(unit - constant[3] * unit);
    case BlendFactor::source_alpha_saturate: {
      const W free = unit - stored[3], alpha = source[3] * unit;
      return channel == 3 ? W(unit) : select(alpha < free, alpha, free);
    }
  }
  return W(0);
}

/// `source` blended with what is `stored`, in the frame's format, as merge() makes it (OpenGL 2.1 spec 4.1.8). In
/// double, for the layers' errors add up: a product of a colour and a code is exact there, and the sum is rounded to
/// codes as the real number would be, but for sums within some 2^-45 codes of a half.
template <class R>
Color<R> blend(const Blend& state, const Color<R>& source, const Color<R>& stored, float scale) {
  using W = Wide<R>;
  const bool codes = scale != 0.0f;
  const double unit = codes ? scale : 1.0;
  const auto wide = [&](R value) { return to_wide(codes ? clamp01(value) : value); };
  const W s[4] = {wide(source.r), wide(source.g), wide(source.b), wide(source.a)};
  const W d[4] = {to_wide(stored.r), to_wide(stored.g), to_wide(stored.b), to_wide(stored.a)};
  const auto channel = [&](int c) {
    const BlendTerm& term = c < 3 ? state.rgb : state.alpha;
    const auto of_source = [&] { return s[c] * blend_factor(term.source, c, s, d, state.color, unit); };
    const auto of_stored = [&] { return d[c] * blend_factor(term.destination, c, s, d, state.color, unit) / unit; };
    W sum(0);
    switch (term.equation) {
      case BlendEquation::add: sum = of_source() + of_stored(); break;
      case BlendEquation::subtract: sum = of_source() - of_stored(); break;
      case BlendEquation::reverse_subtract: sum = of_stored() - of_source(); break;
      case BlendEquation::min: sum = select(s[c] * unit < d[c], s[c] * unit, d[c]); break;
      case BlendEquation::max: sum = select(s[c] * unit > d[c], s[c] * unit, d[c]); break;
    }
    if (!codes) return to_float(sum);
    const W low = select(sum > 0.0, sum, W(0));
    return to_float(round_even(select(low < unit, low, W(unit))));
  };
  return {channel(0), channel(1), channel(2), channel(3)};
}

/// `source`, in codes as merge() makes it, and what is `stored`, bit by bit (OpenGL 2.1 spec 4.1.10); a float colour
/// replaces what is there.
template <class R>
Color<R> logic(LogicOp op, const Color<R>& source, const Color<R>& stored, float scale) {
  const Color<R> code = merge<R>(source, scale);
  if (scale == 0.0f) return code;
  // OpenGL numbers its ops by what they make of (s, d) = (1, 1), (1, 0), (0, 1), (0, 0), from the lowest bit up.
  const auto table = static_cast<unsigned>(op);
  const Int<R> all(static_cast<int>(scale)), none(0);
  const auto where = [&](unsigned bit) { return (table >> bit & 1u) != 0 ? all : none; };
  const auto channel = [&](R from, R to) {
    const Int<R> s = to_int(from), d = to_int(to);
    return to_float((where(0) & s & d) | (where(1) & s & (d ^ all)) | (where(2) & (s ^ all) & d) |
                    (where(3) & (s ^ all) & (d ^ all)));
  };
  return {channel(code.r, stored.r), channel(code.g, stored.g), channel(code.b, stored.b), channel(code.a, stored.a)};
}

}  // namespace plumbline::pipeline

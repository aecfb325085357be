// Stage 11: the fragment's colour, blended or combined with the frame's, in the frame's format.
#pragma once

#include <array>

#include "kernels/attributes.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// `scale` 255, 4095, 65535: rgba8, rgba12, rgba16. Clamped to [0,1], times the scale, and rounded to the nearest code,
/// half to even (GL 2.1 spec 2.14.9), which a float holds exactly. The product is a float's of up to 12 bits: a colour
/// within 2^-25 of half way between two codes may go to either. Of 16 bits it is exact. `scale` 0: float, as it is.
template <class R>
[[gnu::always_inline]] inline Color<R> merge(const Color<R>& color, float scale) {
  if (scale == 0.0f) return color;
  if (scale > 4095.0f) {
    const auto wide_code = [&](R value) { return to_float(round_even(to_wide(clamp01(value)) * Wide<R>(scale))); };
    return {wide_code(color.r), wide_code(color.g), wide_code(color.b), wide_code(color.a)};
  }
  const auto code = [&](R value) { return round_even(clamp01(value) * scale); };
  return {code(color.r), code(color.g), code(color.b), code(color.a)};
}

template <class W>
using Channels = std::array<W, 4>;

/// The same of rgba8, packed.
template <class R>
[[gnu::always_inline]] inline Int<R> packed_merge(const Color<R>& color) {
  const R most(255.0f);
  return packed_codes(color.r * most, color.g * most, color.b * most, color.a * most);
}

/// The same where no channel is beyond 2^22.
template <class R>
[[gnu::always_inline]] inline Int<R> packed_merge_near(const Color<R>& color) {
  const R most(255.0f);
  return packed_codes_near(color.r * most, color.g * most, color.b * most, color.a * most);
}

/// A blend factor's channels, times `unit`, so that those of the frame's colour are its codes and rounded nowhere.
/// `source` in [0,1] and `stored` in codes, or both as they are, and unit 1.
template <class W>
[[gnu::always_inline]] inline Channels<W> blend_factor(BlendFactor factor, const Channels<W>& source,
                                                       const Channels<W>& stored, const glm::vec4& constant,
                                                       double unit) {
  const auto each = [](auto of) { return Channels<W>{of(0u), of(1u), of(2u), of(3u)}; };
  const auto all = [](const W& value) { return Channels<W>{value, value, value, value}; };
  const auto given = [&](int i) { return static_cast<double>(constant[i]) * unit; };
  switch (factor) {
    case BlendFactor::zero: return all(W(0));
    case BlendFactor::one: return all(W(unit));
    case BlendFactor::source_color: return each([&](unsigned i) { return source[i] * unit; });
    case BlendFactor::one_minus_source_color: return each([&](unsigned i) { return unit - source[i] * unit; });
    case BlendFactor::destination_color: return stored;
    case BlendFactor::one_minus_destination_color: return each([&](unsigned i) { return unit - stored[i]; });
    case BlendFactor::source_alpha: return all(source[3] * unit);
    case BlendFactor::one_minus_source_alpha: return all(unit - source[3] * unit);
    case BlendFactor::destination_alpha: return all(stored[3]);
    case BlendFactor::one_minus_destination_alpha: return all(unit - stored[3]);
    case BlendFactor::constant_color: return {W(given(0)), W(given(1)), W(given(2)), W(given(3))};
    case BlendFactor::one_minus_constant_color:
      return {W(unit - given(0)), W(unit - given(1)), W(unit - given(2)), W(unit - given(3))};
    case BlendFactor::constant_alpha: return all(W(given(3)));
    case BlendFactor::one_minus_constant_alpha: return all(W(unit - given(3)));
    case BlendFactor::source_alpha_saturate: {
      const W least = lesser_of(source[3] * unit, unit - stored[3]);
      return {least, least, least, W(unit)};
    }
  }
  return all(W(0));
}

/// The commonest: source alpha, and one minus it.
constexpr BlendTerm kOverTerm{BlendFactor::source_alpha, BlendFactor::one_minus_source_alpha, BlendEquation::add};
constexpr Blend kOver{kOverTerm, kOverTerm, glm::vec4(0)};
inline bool is_over(const Blend& blend) { return blend.rgb == kOverTerm && blend.alpha == kOverTerm; }

/// One channel of kOver, in codes but not rounded to them: `source` in [0,1], `alpha_codes` its alpha times the largest
/// code, `rest` 1 - alpha.
template <class W>
[[gnu::always_inline]] inline W over(const W& source, const W& alpha_codes, const W& stored, const W& rest) {
  return source * alpha_codes + stored * rest;
}
/// blend() by kOver of rgba8, `held` and the result packed.
template <class R>
[[gnu::always_inline]] inline Int<R> packed_over(const Color<R>& source, const Int<R>& held) {
  using W = Wide<R>;
  const Int<R> most(255);
  const W alpha = to_wide(clamp01(source.a)), codes = alpha * 255.0, rest = 1.0 - alpha;
  const auto code = [&](const R& channel, const Int<R>& stored) {
    return nearest_int(over<W>(to_wide(clamp01(channel)), codes, to_wide(stored), rest));
  };
  return (code(source.r, held & most) | shifted_left<8>(code(source.g, shifted_right<8>(held) & most))) |
         (shifted_left<16>(code(source.b, shifted_right<16>(held) & most)) |
          shifted_left<24>(code(source.a, shifted_right<24>(held) & most)));
}

/// `source` blended with what is `stored`, in the frame's format, as merge() makes it (OpenGL 2.1 spec 4.1.8). In
/// double, for the layers' errors add up: a product of a colour and a code is exact there, and the sum is rounded to
/// codes as the real number would be, but for sums within some 2^-45 codes of a half.
template <class R>
[[gnu::always_inline]] inline Color<R> blend(const Blend& state, const Color<R>& source, const Color<R>& stored,
                                             float scale) {
  using W = Wide<R>;
  const bool codes = scale != 0.0f;
  const double unit = codes ? scale : 1.0;
  const auto wide = [&](R value) { return to_wide(codes ? clamp01(value) : value); };
  if (codes && is_over(state)) {
    const W alpha = wide(source.a), alpha_codes = alpha * unit, rest = 1.0 - alpha;
    const auto code = [&](const R& channel, const R& held) {
      return to_float(round_even(over<W>(wide(channel), alpha_codes, to_wide(held), rest)));
    };
    return {code(source.r, stored.r), code(source.g, stored.g), code(source.b, stored.b), code(source.a, stored.a)};
  }
  const Channels<W> s = {wide(source.r), wide(source.g), wide(source.b), wide(source.a)};
  const Channels<W> d = {to_wide(stored.r), to_wide(stored.g), to_wide(stored.b), to_wide(stored.a)};
  const auto blended = [&](const BlendTerm& term) -> Color<R> {
    const auto each = [&](auto of) -> Color<R> {
      const auto stored_as = [&](const W& sum) {
        return to_float(codes ? round_even(clamped<W>(sum, W(0), W(unit))) : sum);
      };
      return {stored_as(of(0u)), stored_as(of(1u)), stored_as(of(2u)), stored_as(of(3u))};
    };
    if (term.equation == BlendEquation::min) return each([&](unsigned i) { return lesser_of(s[i] * unit, d[i]); });
    if (term.equation == BlendEquation::max) return each([&](unsigned i) { return greater_of(s[i] * unit, d[i]); });
    const Channels<W> k = blend_factor<W>(term.source, s, d, state.color, unit);
    const Channels<W> m = blend_factor<W>(term.destination, s, d, state.color, unit);
    if (term.equation == BlendEquation::subtract)
      return each([&](unsigned i) { return s[i] * k[i] - d[i] * m[i] / unit; });
    if (term.equation == BlendEquation::reverse_subtract)
      return each([&](unsigned i) { return d[i] * m[i] / unit - s[i] * k[i]; });
    return each([&](unsigned i) { return s[i] * k[i] + d[i] * m[i] / unit; });
  };
  Color<R> out = blended(state.rgb);
  if (state.alpha != state.rgb) out.a = blended(state.alpha).a;
  return out;
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

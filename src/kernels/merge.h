// Stage 11: the fragment's colour, blended or combined with the frame's, in the frame's format.
#pragma once

#include "kernels/attributes.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Colour in the frame's format. `scale` 255, 4095, 65535: rgba8, rgba12, rgba16. Clamped to [0,1], times the scale,
/// and rounded to the nearest code, half to even (GL 2.1 spec 2.14.9), which a float holds exactly. For up to 12 bits
/// the product is rounded to float: a colour within about 2^-25 of half way between two codes may go to either. For 16
/// bits it is exact. `scale` 0: float, as it is.
template <class R>
[[gnu::always_inline]] inline Color<R> merge(const Color<R>& color, float scale) {
  if (scale == 0.0f) return color;
  return by_channel(color, [&](const R& value) -> R {
    if (scale > 4095.0f) return to_float(round_even(to_wide(clamp01(value)) * Wide<R>(scale)));
    return round_even(clamp01(value) * scale);
  });
}

/// merge() into rgba8, packed.
template <class R>
[[gnu::always_inline]] inline Int<R> packed_merge(const Color<R>& color) {
  const Color<R> codes = color * R(255.0f);
  return packed_codes(codes.r, codes.g, codes.b, codes.a);
}

/// packed_merge() where no channel is beyond 2^22.
template <class R>
[[gnu::always_inline]] inline Int<R> packed_merge_near(const Color<R>& color) {
  const Color<R> codes = color * R(255.0f);
  return packed_codes_near(codes.r, codes.g, codes.b, codes.a);
}

/// Blend factor times `unit`. `unit`: the frame's largest code, with `source` in [0,1] and `stored` in codes, so that
/// factors made of `stored` are codes and not rounded; 1 in a float frame, with both as they are.
template <class W>
[[gnu::always_inline]] inline Color<W> blend_factor(BlendFactor factor, const Color<W>& source, const Color<W>& stored,
                                                    const glm::vec4& constant, double unit) {
  const auto all = [](const W& value) { return Color<W>(value); };
  const auto rest = [&](const Color<W>& of) { return W(unit) - of; };
  const Color<W> own = source * W(unit), fixed = Color<W>(constant) * W(unit);
  switch (factor) {
    case BlendFactor::zero: break;
    case BlendFactor::one: return all(W(unit));
    case BlendFactor::source_color: return own;
    case BlendFactor::one_minus_source_color: return rest(own);
    case BlendFactor::destination_color: return stored;
    case BlendFactor::one_minus_destination_color: return rest(stored);
    case BlendFactor::source_alpha: return all(own.a);
    case BlendFactor::one_minus_source_alpha: return rest(all(own.a));
    case BlendFactor::destination_alpha: return all(stored.a);
    case BlendFactor::one_minus_destination_alpha: return rest(all(stored.a));
    case BlendFactor::constant_color: return fixed;
    case BlendFactor::one_minus_constant_color: return rest(fixed);
    case BlendFactor::constant_alpha: return all(fixed.a);
    case BlendFactor::one_minus_constant_alpha: return rest(all(fixed.a));
    case BlendFactor::source_alpha_saturate: {
      const W least = lesser_of(own.a, W(unit) - stored.a);
      return {least, least, least, W(unit)};
    }
  }
  return all(W(0));
}

/// The most common blending: source alpha, one minus source alpha.
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

/// Blended colour (OpenGL 2.1 spec 4.1.8). `source`: as stage 9 makes it; `stored` and the result: in the frame's
/// format, as merge() makes it. In double, as the errors of many layers add up: a product of a colour and a code is
/// exact, and the sum is rounded to codes as the real number would be, except for sums within some 2^-45 codes of a
/// half.
template <class R>
[[gnu::always_inline]] inline Color<R> blend(const Blend& state, const Color<R>& source, const Color<R>& stored,
                                             float scale) {
  using W = Wide<R>;
  const bool codes = scale != 0.0f;
  const double unit = codes ? scale : 1.0;
  const auto wide = [&](R value) { return to_wide(codes ? clamp01(value) : value); };
  if (codes && is_over(state)) {
    const W alpha = wide(source.a), alpha_codes = alpha * unit, rest = 1.0 - alpha;
    return by_channel(source, stored, [&](const R& channel, const R& held) {
      return to_float(round_even(over<W>(wide(channel), alpha_codes, to_wide(held), rest)));
    });
  }
  const auto as_it_is = [](const R& value) { return to_wide(value); };
  const Color<W> s = by_channel(source, wide), d = by_channel(stored, as_it_is);
  const auto blended = [&](const BlendTerm& term) {
    using E = BlendEquation;
    const bool weighs = term.equation != E::min && term.equation != E::max;
    const auto weighted = [&](const Color<W>& c, BlendFactor factor) {
      const Color<W> k = blend_factor<W>(weighs ? factor : BlendFactor::one, s, d, state.color, unit);
      return c * k;
    };
    const auto sum = [&](const W& a, const W& b_unit) -> W {
      const W b = b_unit / W(unit);
      switch (term.equation) {
        case E::add: break;
        case E::subtract: return a - b;
        case E::reverse_subtract: return b - a;
        case E::min: return lesser_of(a, b);
        case E::max: return greater_of(a, b);
      }
      return a + b;
    };
    return by_channel(weighted(s, term.source), weighted(d, term.destination), [&](const W& a, const W& b) {
      return to_float(codes ? round_even(clamped<W>(sum(a, b), W(0), W(unit))) : sum(a, b));
    });
  };
  Color<R> out = blended(state.rgb);
  if (state.alpha != state.rgb) out.a = blended(state.alpha).a;
  return out;
}

/// Logic op, bit by bit, of source's code, as merge() makes it, and of `stored`, a code (OpenGL 2.1 spec 4.1.10). In a
/// float frame (`scale` 0): `source`, unchanged.
template <class R>
Color<R> logic(LogicOp op, const Color<R>& source, const Color<R>& stored, float scale) {
  const Color<R> code = merge<R>(source, scale);
  if (scale == 0.0f) return code;
  // OpenGL numbers its ops by what they make of (s, d) = (1, 1), (1, 0), (0, 1), (0, 0), from the lowest bit up.
  const auto table = static_cast<unsigned>(op);
  const Int<R> all(static_cast<int>(scale)), none(0);
  const auto where = [&](unsigned bit) { return (table >> bit & 1u) != 0 ? all : none; };
  return by_channel(code, stored, [&](const R& from, const R& to) {
    const Int<R> s = to_int(from), d = to_int(to);
    return to_float((where(0) & s & d) | (where(1) & s & (d ^ all)) | (where(2) & (s ^ all) & d) |
                    (where(3) & (s ^ all) & (d ^ all)));
  });
}

}  // namespace plumbline::pipeline

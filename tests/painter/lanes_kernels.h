// The words of lanes.h and the functions written in them, over arrays: for float, and by every SIMD target.
#pragma once

#include <cstddef>

#include "kernels/light_equation.h"
#include "kernels/merge.h"
#include "kernels/texture.h"

namespace plumbline::pipeline {

/// Kernels over n items in columns: number k of all items begins at k * n, in input and output. n: a multiple of every
/// lane width.
struct Kernels {
  void (*words)(std::size_t n, const float* in, float* out);                              ///< of a, b: kWords
  void (*sample)(const TextureSetup& setup, std::size_t n, const float* in, float* out);  ///< of s, t, lod
  /// Inputs: colour, normal and position.
  void (*lit)(const FragmentLight& light, LitPart part, std::size_t n, const float* in, float* out);
  void (*blend)(const Blend& state, float scale, std::size_t n, const float* in, float* out);  ///< source, stored
};
inline constexpr std::size_t kWords = 36;
inline constexpr std::size_t kItems = 1024;

template <class R>
struct Columns {
  std::size_t n, i;
  const float* in;
  float* out;
  R operator()(std::size_t k) const { return Lanes<R>::load(in + k * n + i); }
  Color<R> color(std::size_t k) const { return {(*this)(k), (*this)(k + 1), (*this)(k + 2), (*this)(k + 3)}; }
  void put(R value) {
    store(R(0) == R(0), value, out + i);
    out += n;
  }
  /// Stores all bits, in three floats.
  void put_wide(const Wide<R>& value) {
    const R high = to_float(value);
    const Wide<R> rest = value - to_wide(high);
    const R low = to_float(rest);
    put(high), put(low), put(to_float(rest - to_wide(low)));
  }
  void put(const Color<R>& c) { put(c.r), put(c.g), put(c.b), put(c.a); }
};

template <class R>
void each(std::size_t n, const float* in, float* out, auto function) {
  for (std::size_t i = 0; i < n; i += Lanes<R>::width) function(Columns<R>{n, i, in, out});
}

template <class R>
void words(std::size_t n, const float* in, float* out) {
  using W = Wide<R>;
  each<R>(n, in, out, [](Columns<R> of) {
    const R a = of(0), b = of(1);
    const W wide = to_wide(a), product = wide * to_wide(b);
    of.put(greater_of(a, b));
    of.put(lesser_of(a, b));
    of.put(clamp01(a));
    of.put(select(a < b, a, b));
    of.put(round_even(a));
    of.put(square_root(a));
    of.put(power(a, 0.3f));
    of.put(power(a, 128.0f));
    of.put(magnitude(a));
    const Int<R> packed = packed_codes(a, b, a * R(255.0f), b * R(0.25f));
    of.put(to_float(packed & Int<R>(0xffff)));
    of.put(to_float(shifted_right<16>(packed) & Int<R>(0xffff)));
    of.put(to_float(to_int(floor_of(clamped(wide, W(-0x1p40), W(0x1p40)))) & Int<R>(0xffff)));
    of.put_wide(floor_of(product));
    of.put_wide(mantissa_of(product));
    of.put_wide(exponent_of(product));
    of.put_wide(power_of_two(round_even(clamped(product, W(-126), W(126)))));
    of.put_wide(log2_of(product));
    of.put_wide(exp2_of(product));
    of.put_wide(wrapped(Wrap::repeat, floor_of(clamped(product, W(-0x1p40), W(0x1p40))), W(1001.0)));
    of.put_wide(mirrored(clamped(product, W(-0x1p40), W(0x1p40)), W(1001.0)));
  });
}

template <class R>
Kernels kernels() {
  const auto sample_each = [](const TextureSetup& setup, std::size_t n, const float* in, float* out) {
    each<R>(n, in, out, [&](Columns<R> of) { of.put(sample<R>(setup, {of(0), of(1)}, of(2))); });
  };
  const auto lit_each = [](const FragmentLight& light, LitPart part, std::size_t n, const float* in, float* out) {
    each<R>(n, in, out, [&](Columns<R> of) {
      const Color<R> normal{of(4), of(5), of(6), R(0)}, position{of(7), of(8), of(9), R(1)};
      of.put(lit_fragment<R>(light, part, of.color(0), normal, position));
    });
  };
  const auto blend_each = [](const Blend& state, float scale, std::size_t n, const float* in, float* out) {
    each<R>(n, in, out, [&](Columns<R> of) { of.put(blend<R>(state, of.color(0), of.color(4), scale)); });
  };
  return {words<R>, sample_each, lit_each, blend_each};
}

Kernels kernels_sse4();
Kernels kernels_avx2();
Kernels kernels_avx512();

}  // namespace plumbline::pipeline

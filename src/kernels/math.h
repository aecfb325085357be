// Mathematics over the lane type. Colours and vectors are glm's. Written here: functions that glm has for plain floats
// only, and log2, exp2 and power, for which C libraries do not promise equal bits on every machine.
#pragma once

#include "kernels/lanes.h"

namespace plumbline::pipeline {

inline constexpr double kRadians = 3.14159265358979323846 / 180.0;  ///< one degree [radians]

/// rgba of Lanes<R>::width vertices or fragments.
template <class R>
using Color = Vec4<R>;
/// Colour of f(channel), or of f(channel of c, channel of d).
template <class R>
[[gnu::always_inline]] inline auto by_channel(const Color<R>& c, auto f) {
  return Color<decltype(f(c.r))>{f(c.r), f(c.g), f(c.b), f(c.a)};
}
template <class R, class S>
[[gnu::always_inline]] inline auto by_channel(const Color<R>& c, const Color<S>& d, auto f) {
  return Color<decltype(f(c.r, d.r))>{f(c.r, d.r), f(c.g, d.g), f(c.b, d.b), f(c.a, d.a)};
}

template <class R>
Color<R> select(Mask<R> mask, const Color<R>& yes, const Color<R>& no) {
  return by_channel(yes, no, [&](const R& a, const R& b) { return select(mask, a, b); });
}
template <class R>
Vec3<R> select(Mask<R> mask, const Vec3<R>& yes, const Vec3<R>& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}

template <class R>
R dot(const Vec3<R>& a, const Vec3<R>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class R>
R length(const Vec3<R>& v) {
  return square_root(dot(v, v));
}
template <class R>
Vec3<R> unit(const Vec3<R>& v) {
  return v / length(v);
}

/// Product of a matrix and a point (w = 1), or a direction; its terms are summed from left to right.
template <class R>
[[gnu::always_inline]] inline Vec4<R> product(const Mat4<float>& m, const Vec3<R>& p) {
  return ((Vec4<R>(m[0]) * p.x + Vec4<R>(m[1]) * p.y) + Vec4<R>(m[2]) * p.z) + Vec4<R>(m[3]);
}
template <class R>
[[gnu::always_inline]] inline Vec3<R> product(const Mat3<float>& m, const Vec3<R>& v) {
  return (Vec3<R>(m[0]) * v.x + Vec3<R>(m[1]) * v.y) + Vec3<R>(m[2]) * v.z;
}

/// log2(x) for normal x > 0. Relative error of the result below 1e-12 (atanh series up to t^15, |t| <= 0.1716).
template <class W>
W log2_of(W x) {
  constexpr double kTerms[] = {1.0 / 13, 1.0 / 11, 1.0 / 9, 1.0 / 7, 1.0 / 5, 1.0 / 3, 1.0};
  const W mantissa = mantissa_of(x), exponent = exponent_of(x);
  const auto upper = mantissa > 1.4142135623730951;
  const W m = select(upper, mantissa * 0.5, mantissa);
  const W t = (m - 1.0) / (m + 1.0), t2 = t * t;
  W series(1.0 / 15);
  for (const double term : kTerms) series = series * t2 + term;
  return select(upper, exponent + 1.0, exponent) + series * t * 2.8853900817779268;  // 2 / ln 2
}

/// 2^x for x in [-1022, 1023]; below, 0. Relative error below 1e-13 (Taylor to the 12th power, |x - n| <= 1/2).
template <class W>
W exp2_of(W x) {
  // 1 / k!, exactly rounded
  constexpr double kTerms[] = {1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040, 1.0 / 720,
                               1.0 / 120,      1.0 / 24,      1.0 / 6,      1.0 / 2,     1.0,        1.0};
  const W n = round_even(x), f = (x - n) * 0.69314718055994531;
  W series(1.0 / 479001600);
  for (const double term : kTerms) series = series * f + term;
  return select(x < -1022.0, W(0), series * power_of_two(n));
}

/// x^y for y in [0, 128], in double, rounded once to R; at most 2^127. 0^0 = 1; for y > 0, 0 where x <= 0 or x is NaN.
/// Relative error before the last rounding: below 1e-9.
template <class R>
R power(R x, float y) {
  using W = Wide<R>;
  if (y == 0.0f) return R(1);
  const Mask<R> positive = x > R(0);
  if (!any(positive)) return R(0);
  const W exponent = static_cast<double>(y) * log2_of(to_wide(select(positive, x, R(1))));
  return select(positive, to_float(exp2_of(lesser_of(exponent, W(127)))), R(0));
}

}  // namespace plumbline::pipeline

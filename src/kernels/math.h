// Our own transcendental functions: the same bits on every machine, which a C library does not promise. And degrees.
#pragma once

#include "kernels/lanes.h"

namespace plumbline::pipeline {

inline constexpr double kRadians = 3.14159265358979323846 / 180.0;  ///< a degree

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

/// x^y for x >= 0 and y in [0, 128], at most 2^127; 0^0 = 1. Relative error below 1e-9 where the result is above
/// 1e-300.
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

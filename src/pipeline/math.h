// Our own transcendental functions: the same bits on every machine, which a C library does not promise. And degrees.
#pragma once

#include <bit>
#include <cstdint>

namespace plumbline::pipeline {

inline constexpr double kRadians = 3.14159265358979323846 / 180.0;  ///< a degree

/// log2(x) for normal x > 0. Relative error of the result below 1e-12 (atanh series up to t^15, |t| <= 0.1716).
inline double log2_of(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  std::int64_t exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0xfffffffffffffull) | 0x3ff0000000000000ull);  // [1, 2)
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  const double t = (m - 1.0) / (m + 1.0), t2 = t * t;
  double series = 1.0 / 15;
  for (int k = 13; k >= 1; k -= 2) series = series * t2 + 1.0 / k;
  return static_cast<double>(exponent) + series * t * 2.8853900817779268;  // 2 / ln 2
}

/// 2^x for x in [-1022, 1023]; below, 0. Relative error below 1e-13 (Taylor to the 12th power, |x - n| <= 1/2).
inline double exp2_of(double x) {
  if (x < -1022.0) return 0.0;
  const double shifted = x + 6755399441055744.0;  // 1.5 * 2^52: rounds to an integer
  const double n = shifted - 6755399441055744.0;
  const double f = (x - n) * 0.69314718055994531;
  double series = 1.0;
  for (int k = 12; k >= 1; --k) series = series * (f / k) + 1.0;
  const auto exponent = static_cast<std::uint64_t>(static_cast<std::int64_t>(n) + 1023);
  return series * std::bit_cast<double>(exponent << 52);
}

/// x^y for x >= 0 and y in [0, 128], at most 2^127; 0^0 = 1. Relative error below 1e-9 where the result is above
/// 1e-300.
inline float power(float x, float y) {
  if (y == 0.0f) return 1.0f;
  if (!(x > 0.0f)) return 0.0f;
  const double exponent = static_cast<double>(y) * log2_of(static_cast<double>(x));
  return exponent < 127.0 ? static_cast<float>(exp2_of(exponent)) : 0x1p127f;
}

}  // namespace plumbline::pipeline

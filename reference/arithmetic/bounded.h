// Numbers with an error bound, and the rounding errors of float arithmetic.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/glm.hpp>

namespace plumbline::math {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

inline constexpr double kFloatRounding = 1.0 / (1 << 24);  ///< u, the unit roundoff of float: half an ULP of 1

/// Absolute error of one rounding to a result below float's smallest normal number, 2^-126, where u of the result is
/// too little. Gradual underflow (IEEE 754, 7.5): half of the smallest step, 2^-149. Flushed: numbers below 2^-126
/// become 0, as operands and as results; Mesa sets the processor so for its vertices and for llvmpipe (util_fpstate).
inline constexpr double kGradualUnderflow = 0x1p-150, kFlushedUnderflow = 0x1p-126;

/// Rounding error of a computation in float.
struct Roundings {
  double count;                          ///< roundings, each of the whole magnitude
  double underflow = kGradualUnderflow;  ///< absolute error of each by underflow
  /// Error of a result whose terms' absolute values sum to `magnitude`. A sum of nothing but zeros is not rounded.
  double operator()(double magnitude) const {
    return magnitude == 0 ? 0 : count * (kFloatRounding * magnitude + underflow);
  }
};

/// A number, with a bound on the absolute error of another renderer's value for it.
struct Bounded {
  double value = 0, error = 0;
};
/// Four numbers (a colour, a position) with one bound on the absolute error of each; infinite: no bound.
struct BoundedFour {
  glm::dvec4 value{0};
  double bound = 0;
};

/// Largest distance [length] between the unit vectors of v and of v + d, |d| <= ratio |v|: the chord 2 sin(asin(ratio)
/// / 2) of their angle. 2 for a ratio of 1 or more: no direction is certain.
inline double chord(double ratio) {
  if (!(ratio < 1)) return 2;
  return ratio * std::sqrt(2 / (1 + std::sqrt(1 - ratio * ratio)));
}

/// Operations of the texture environment on real numbers.
struct Exactly {
  static double product(double a, double b) { return a * b; }
  static double mixed(double a, double b, double share) { return a * (1 - share) + b * share; }
  static double clamped_sum(double a, double b) { return std::clamp(a + b, 0.0, 1.0); }
};

/// Operations of the texture environment on bounded numbers, for a renderer that rounds each result.
struct Rounding {
  Roundings roundings;
  Bounded product(Bounded a, Bounded b) const {
    const double v = a.value * b.value;
    return {v, std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error + roundings(std::abs(v))};
  }
  // Mix by either form: a (1 - share) + b share, or a + (b - a) share.
  Bounded mixed(Bounded a, Bounded b, Bounded share) const {
    const double k = share.value, terms = std::max(std::abs(a.value * (1 - k)) + std::abs(b.value * k),
                                                   std::abs(a.value) + std::abs((b.value - a.value) * k));
    return {a.value * (1 - k) + b.value * k, std::abs(1 - k) * a.error + std::abs(k) * b.error +
                                                 (std::abs(b.value - a.value) + a.error + b.error) * share.error +
                                                 roundings(terms)};
  }
  Bounded clamped_sum(Bounded a, Bounded b) const {
    const double v = a.value + b.value;
    return {std::clamp(v, 0.0, 1.0), a.error + b.error + roundings(std::abs(v))};
  }
};

}  // namespace plumbline::math

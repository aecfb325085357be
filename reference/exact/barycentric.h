// Barycentric weights of fragments, for stages 6 and 7.
#pragma once

#include <array>

#include "capture/stages.h"
#include "reference/exact/wide.h"

namespace plumbline::exact {

/// Weights of a triangle's corners at pixels, in the window, without perspective; they sum to 1. They are computed from
/// the *unsnapped* window positions, or, where these have no area or the other facing, from the snapped ones.
///
/// Along a line, the second corner's weight is (p - a).(b - a) / |b - a|^2, the third's 0 (OpenGL 2.1, equation 3.5);
/// for a point both are 0.
///
/// The set-up has 113 bits, so that a sliver's area and gradients are right. Weights are evaluated relative to the
/// first corner in long double, or in 113 bits where they are small differences of large terms (slivers): their error
/// is at most 2^-52 of the largest weight.
class Barycentric {
 public:
  /// Weights of a triangle, a line or a point. Of a triangle without a snapped area: by the unsnapped corners; not
  /// finite where these lie on one line.
  /// `width`, `height`: of the frame [pixels].
  Barycentric(const WindowTriangle<double>& triangle, int width, int height);

  /// Weights at pixel (x, y)'s centre + `off` [pixels].
  std::array<long double, 3> at(int x, int y, glm::dvec2 off = {0, 0}) const;

  /// Slopes along x and y [per pixel] of a quantity that is 0 at the first corner and has these values at the others.
  std::array<Float128, 2> slope(double at_second, double at_third) const;

 private:
  template <class T>
  struct Affine {
    T x0, y0;        // the first corner [pixels], at which the other corners' weights are 0
    T d1_dx, d1_dy;  // gradient of the second corner's weight
    T d2_dx, d2_dy;  // gradient of the third corner's weight
  };
  template <class T>
  static std::array<long double, 3> at(const Affine<T>& affine, glm::dvec2 p);

  Affine<Float128> exact_;
  Affine<long double> rounded_;
  bool rounded_suffices_;
};

}  // namespace plumbline::exact

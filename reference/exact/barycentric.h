// Where in its triangle a fragment lies: the ground of stages 6 and 7.
#pragma once

#include <array>

#include "capture/stages.h"
#include "reference/exact/wide.h"

namespace plumbline::exact {

/// Weights of a triangle's corners at pixel centres, in the window; they sum to 1. Through the *unsnapped* window
/// positions, or where those have no area or the other facing, the snapped ones.
///
/// Along a line, the second corner's is (p - a).(b - a) / |b - a|^2, the third's 0 (OpenGL 2.1, equation 3.5); of a
/// point both are 0.
///
/// The set-up is in 113 bits, so that a sliver's area and gradients are right; the weights are evaluated in long double
/// from the first corner on, or where their terms are large (a sliver, whose weights are small differences of them)
/// in 113 bits: they are good to 2^-52 relative to the largest weight.
class Barycentric {
 public:
  /// Of a triangle with a snapped area, a line or a point; else the weights are NaN. `width`, `height` of the frame, in
  /// pixels.
  Barycentric(const WindowTriangle<double>& triangle, int width, int height);

  /// At pixel (x, y)'s centre, or `off` it, in pixels.
  std::array<long double, 3> at(int x, int y, glm::dvec2 off = {0, 0}) const;

  /// Along x and along y, per pixel, of what is 0 at the first corner and has these values at the others.
  std::array<Float128, 2> slope(double at_second, double at_third) const;

 private:
  template <class T>
  struct Affine {
    T x0, y0;        // the first corner, in pixels
    T d1_dx, d1_dy;  // the second corner's weight: its gradient; it is 0 at the first corner
    T d2_dx, d2_dy;  // the third's
  };
  template <class T>
  static std::array<long double, 3> at(const Affine<T>& affine, glm::dvec2 p);

  Affine<Float128> exact_;
  Affine<long double> rounded_;
  bool rounded_suffices_;
};

}  // namespace plumbline::exact

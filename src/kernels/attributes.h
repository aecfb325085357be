// Stage 7: attributes, perspective-correct.
//
// An attribute a is not affine in the window, a/w and 1/w are (Heckbert, Interpolation for polygon texture mapping and
// shading, 1991): a = sum(l_i a_i / w_i) / sum(l_i / w_i). Written as a weighted mean, a = a0 + k1 (a1 - a0) + k2 (a2 -
// a0) with k_i = (l_i / w_i) / sum, it is exact for equal corners, and its rounding is bounded by the corners' values.
#pragma once

#include <array>

#include "capture/stages.h"
#include "kernels/depth.h"
#include "kernels/math.h"

namespace plumbline::pipeline {

/// 1/w at the corners, and what is affine by it: q_1 = l_1 / w_1, q_2 likewise, and the sum of all three.
struct PerspectiveSetup {
  std::array<float, 3> inv_w;
  Affine<double> q1, q2, sum;
};
template <class W>
[[gnu::always_inline]] inline Affine<W> scaled(const Affine<W>& f, const W& by) {
  return {f.at_0 * by, f.x * by, f.y * by};
}
PerspectiveSetup perspective_setup(const std::array<float, 3>& inv_w, const CornerPlanes<double>& planes);
PerspectiveSetup perspective_setup(const WindowTriangle& triangle, const CornerPlanes<double>& planes);

struct AttributeSetup {
  Vec4<float> color0, d_color1, d_color2;  ///< corner 0's, and the others' differences from it
  bool constant = false;                   ///< no differences
};
/// Setup of an attribute from its values at the corners.
AttributeSetup attribute_setup(const std::array<Vec4<float>, 3>& corners);

/// k_1 and k_2.
template <class R>
struct Weights {
  R k1, k2;
};
/// Weights from q_1, q_2 and their sum with q_0.
template <class R>
[[gnu::always_inline]] inline Weights<R> weights(const R& q1, const R& q2, const R& sum) {
  // A plane extrapolated out of a sliver may reach the horizon: no division by (nearly) 0 there.
  const R reciprocal = select(magnitude(sum) > R(1.17549435e-38f), R(1) / sum, R(0));
  return {q1 * reciprocal, q2 * reciprocal};
}
template <class R>
[[gnu::always_inline]] inline Weights<R> weights(const PerspectiveSetup& s, const Offset<R>& at) {
  return weights<R>(to_float(value_at<R>(s.q1, at)), to_float(value_at<R>(s.q2, at)), to_float(value_at<R>(s.sum, at)));
}

/// The mean by these weights. `s`: an AttributeSetup, or one of lanes.
template <class R>
[[gnu::always_inline]] inline Color<R> mixed(const auto& s, const Weights<R>& k) {
  return (Color<R>(s.color0) + k.k1 * Color<R>(s.d_color1)) + k.k2 * Color<R>(s.d_color2);
}
/// The same; where there are no differences, without weights.
template <class R>
[[gnu::always_inline]] inline Color<R> mean(const AttributeSetup& s, const Weights<R>& k) {
  if (s.constant) return Color<R>(s.color0) + R(0);  // + 0: -0 is 0, as it is where there are differences
  return mixed<R>(s, k);
}

}  // namespace plumbline::pipeline

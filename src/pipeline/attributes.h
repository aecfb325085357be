// Stage 7: attributes, perspective-correct.
//
// An attribute a is not affine in the window, a/w and 1/w are (Heckbert, Interpolation for polygon texture mapping and
// shading, 1991): a = sum(l_i a_i / w_i) / sum(l_i / w_i). Written as a weighted mean, a = a0 + k1 (a1 - a0) + k2 (a2 -
// a0) with k_i = (l_i / w_i) / sum, it is exact for equal corners, and its rounding is bounded by the corners' values.
#pragma once

#include <type_traits>

#include "pipeline/depth.h"
#include "pipeline/lanes.h"
#include "stages/stages.h"

namespace plumbline::pipeline {

struct AttributeSetup {
  float inv_w[3];
  Vec4<float> color0, d_color1, d_color2;  ///< corner 0's, and the others' differences from it
  bool constant = false;                   ///< no differences
};
AttributeSetup attribute_setup(const WindowTriangle<float>& triangle);

/// rgba of `Lanes<R>::width` fragments.
template <class R>
struct Color {
  R r, g, b, a;
};

/// k_1 and k_2.
template <class R>
struct Weights {
  R k1, k2;
};
/// `S`: float, or R where each lane is another triangle's.
template <class R, class S = float>
[[gnu::always_inline]] inline Weights<R> weights(const S (&inv_w)[3], const Barycentric<R>& b) {
  const R q0 = to_float(b.l0) * inv_w[0], q1 = to_float(b.l1) * inv_w[1], q2 = to_float(b.l2) * inv_w[2];
  const R sum = q0 + q1 + q2;
  // A plane extrapolated out of a sliver may reach the horizon: no division by (nearly) 0 there.
  const R reciprocal = where(magnitude(sum) > R(1.17549435e-38f), R(1) / sum);
  return {q1 * reciprocal, q2 * reciprocal};
}

template <class R, class Setup = AttributeSetup>
[[gnu::always_inline]] inline Color<R> mean(const Setup& s, const Weights<R>& k) {
  if constexpr (std::is_same_v<Setup, AttributeSetup>) {
    // + 0: -0 is 0, as it is where there are differences.
    if (s.constant) return {s.color0[0] + 0.0f, s.color0[1] + 0.0f, s.color0[2] + 0.0f, s.color0[3] + 0.0f};
  }
  const auto channel = [&](int i) { return s.color0[i] + k.k1 * s.d_color1[i] + k.k2 * s.d_color2[i]; };
  return {channel(0), channel(1), channel(2), channel(3)};
}

template <class R>
[[gnu::always_inline]] inline Color<R> attributes(const AttributeSetup& s, const Barycentric<R>& b) {
  return mean<R>(s, weights<R>(s.inv_w, b));
}

}  // namespace plumbline::pipeline

// Stage 7: attributes, perspective-correct.
//
// An attribute a is not affine in the window, a/w and 1/w are (Heckbert, Interpolation for polygon texture mapping and
// shading, 1991): a = sum(l_i a_i / w_i) / sum(l_i / w_i). Written as a weighted mean, a = a0 + k1 (a1 - a0) + k2 (a2 -
// a0) with k_i = (l_i / w_i) / sum, it is exact for equal corners, and its rounding is bounded by the corners' values.
#pragma once

#include "pipeline/depth.h"
#include "pipeline/lanes.h"
#include "stages/stages.h"

namespace plumbline::pipeline {

struct AttributeSetup {
  float inv_w[3];
  Vec4<float> color0, d_color1, d_color2;  ///< corner 0's, and the others' differences from it
};
AttributeSetup attribute_setup(const WindowTriangle<float>& triangle);

/// rgba of `Lanes<R>::width` fragments.
template <class R>
struct Color {
  R r, g, b, a;
};

template <class R>
Color<R> attributes(const AttributeSetup& s, const Barycentric<R>& b) {
  const R q0 = to_float(b.l0) * s.inv_w[0], q1 = to_float(b.l1) * s.inv_w[1], q2 = to_float(b.l2) * s.inv_w[2];
  const R sum = q0 + q1 + q2;
  // A plane extrapolated out of a sliver may reach the horizon: no division by (nearly) 0 there.
  const R tiny(1.17549435e-38f);
  const Mask<R> divides = (sum > tiny) | (sum < -tiny);
  const R reciprocal = select(divides, R(1) / select(divides, sum, R(1)), R(0));
  const R k1 = q1 * reciprocal, k2 = q2 * reciprocal;
  const auto mean = [&](int i) { return s.color0[i] + k1 * s.d_color1[i] + k2 * s.d_color2[i]; };
  return {mean(0), mean(1), mean(2), mean(3)};
}

}  // namespace plumbline::pipeline

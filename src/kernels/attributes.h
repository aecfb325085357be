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

/// Planes of q_1 = l_1 / w_1, q_2 = l_2 / w_2 and sum = q_0 + q_1 + q_2. inv_w: the corners' 1/w, read by src/faults
/// alone.
struct PerspectiveSetup {
  std::array<float, 3> inv_w;
  Affine<double> q1, q2, sum;
  /// Whether q1, q2 and sum are evaluated in double at the first pixel of each 4 x 4 block only, and in float from
  /// there. Set where the draw has no varying and changes_little() holds. (With a texture, float could move a border
  /// between texels off a pixel's centre.)
  bool in_blocks = false;
};
/// f times `by`.
template <class W>
[[gnu::always_inline]] inline Affine<W> scaled(const Affine<W>& f, const W& by) {
  return {f.at_0 * by, f.x * by, f.y * by};
}
/// Whether q_1, q_2 and their sum with q_0 change by at most half of the least 1/w within a block of 4 x 4 pixels, and
/// every 1/w is within (2^-60, 2^60). Then float is enough within blocks, u = 2^-24: with D = |added_in_block()| <=
/// least / 2, a value q is off by u (|q| + D) as the first pixel's is rounded to float, 3 u D for the slopes, the
/// products and their sum, and u |q| for the last sum: 2 u |q| + 4 u D.
template <class W>
[[gnu::always_inline]] inline auto changes_little(const Affine<W>& q1, const Affine<W>& q2, const Affine<W>& sum,
                                                  const W (&inv_w)[3]) {
  const auto size = [](const W& value) { return greater_of(value, -value); };
  const W least = lesser_of(lesser_of(inv_w[0], inv_w[1]), inv_w[2]);
  const W most = greater_of(greater_of(inv_w[0], inv_w[1]), inv_w[2]);
  const auto little = [&](const Affine<W>& f) { return (size(f.x) + size(f.y)) * W(2.0 * (kBlock - 1)) <= least; };
  // Within these bounds of 1/w, slopes, products and reciprocals are normal numbers of float.
  const auto q1_little = little(q1), q2_little = little(q2), sum_little = little(sum);
  return q1_little & q2_little & sum_little & (least > W(0x1p-60)) & (most < W(0x1p60));
}
/// Setup of a window triangle, line or point. `colors_alone`: the draw carries no varying. in_blocks: never set for
/// lines and points.
PerspectiveSetup perspective_setup(const WindowTriangle& triangle, const CornerPlanes<double>& planes,
                                   bool colors_alone);
/// Setup from the corners' 1/w. `may_go_in_blocks`: in_blocks is set where changes_little() holds, else never.
PerspectiveSetup perspective_setup(const std::array<float, 3>& inv_w, const CornerPlanes<double>& planes,
                                   bool may_go_in_blocks);

/// Values of an attribute at a triangle's corners.
struct AttributeSetup {
  Vec4<float> value0, delta1, delta2;  ///< corner 0's, and the others' differences from it
  bool constant = false;               ///< all differences are 0
};
/// Setup of an attribute from its values at the corners.
AttributeSetup attribute_setup(const std::array<Vec4<float>, 3>& corners);

/// Weights k_1 and k_2 of a perspective-correct mean.
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
/// Difference of a plane's value in a column and row of a block from that at the block's first pixel.
template <class R>
[[gnu::always_inline]] inline R added_in_block(const Affine<double>& f, const R& column, const R& row) {
  return column * R(to_float(f.x)) + row * R(to_float(f.y));
}
/// Weights at a fragment. `at`: whole pixels from the tile's first, where s.in_blocks.
template <class R>
[[gnu::always_inline]] inline Weights<R> weights(const PerspectiveSetup& s, const Offset<R>& at) {
  if (!s.in_blocks) {
    return weights<R>(to_float(value_at<R>(s.q1, at)), to_float(value_at<R>(s.q2, at)),
                      to_float(value_at<R>(s.sum, at)));
  }
  const auto first = [](const Wide<R>& offset) {
    return floor_of(offset * (1.0 / kBlock)) * static_cast<double>(kBlock);
  };
  const Offset<R> of_block{first(at.dx), first(at.dy)};
  const R column = to_float(at.dx - of_block.dx), row = to_float(at.dy - of_block.dy);
  const auto value = [&](const Affine<double>& f) {
    return to_float(value_at<R>(f, of_block)) + added_in_block(f, column, row);
  };
  return weights<R>(value(s.q1), value(s.q2), value(s.sum));
}

/// Mean of the corners' values by the weights. `s`: an AttributeSetup, or the painter's AttributeLanes.
template <class R>
[[gnu::always_inline]] inline Color<R> mixed(const auto& s, const Weights<R>& k) {
  return (Color<R>(s.value0) + k.k1 * Color<R>(s.delta1)) + k.k2 * Color<R>(s.delta2);
}
/// mixed(); of a constant attribute the corners' value, whatever the weights are (they may be NaN).
template <class R>
[[gnu::always_inline]] inline Color<R> mean(const AttributeSetup& s, const Weights<R>& k) {
  if (s.constant) return Color<R>(s.value0) + R(0);  // + 0: -0 is 0, as it is where there are differences
  return mixed<R>(s, k);
}

}  // namespace plumbline::pipeline

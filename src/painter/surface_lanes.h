// Stages 7 to 9, and the codes of stage 11, of one pixel of each lane's triangle, coloured by the draw's surface.
// surface_attributes() (fragments.h) and shade() do the same for pixels of one triangle.
#pragma once

#include <array>

#include "kernels/shade.h"
#include "painter/set_up_lanes.h"

namespace plumbline::pipeline {

/// mean() per lane. A lane whose corners are equal gets weights 0, because the computed weights may be NaN.
template <class R>
[[gnu::always_inline]] inline Color<R> mean_of_lanes(const AttributeLanes<R>& s, const Weights<R>& k) {
  const Weights<R> known{select(s.constant, R(0), k.k1), select(s.constant, R(0), k.k2)};
  return mixed<R>(s, known);
}
/// Colours that set_up_colors() stored, as lanes.
template <class R, int kSampleCount>
[[gnu::always_inline]] inline AttributeLanes<R> colors_of(const LaneTriangles<R, kSampleCount>& lanes) {
  AttributeLanes<R> out;
  for (int c = 0; c < 4; ++c) {
    out.value0[c] = Lanes<R>::load(lanes.color[0][c]);
    out.delta1[c] = Lanes<R>::load(lanes.color[1][c]);
    out.delta2[c] = Lanes<R>::load(lanes.color[2][c]);
  }
  out.constant = Lanes<R>::load(lanes.constant_colors) != Int<R>(0);
  return out;
}

/// Shades pixels of the lanes' triangles by a draw's surface, which must outlive it.
template <class R>
class SurfaceLanes {
 public:
  /// `front`: facing of all triangles; without meaning where light has not two sides.
  SurfaceLanes(const Painting& painting, const PaintDraw& draw, const CornersOfLanes<R>& corner,
               const LaneTriangles<R, 1>& lanes, bool front)
      : surface_(*draw.surface),
        front_(front),
        q1_(lanes.q1.of_all()),
        q2_(lanes.q2.of_all()),
        sum_(lanes.sum.of_all()),
        gradients_(lanes.gradients.of_all()),
        color_(colors_of<R>(lanes)) {
    for (const Varying v : surface_.carried) {
      const Vec4<float>* const column = painting.varyings[index_of(v)];
      const auto value_of = [&](std::uint32_t vertex) { return &column[vertex].x; };
      varyings_[index_of(v)] = attribute_lanes<R>(corner, draw.flat() && is_lit(v), value_of);
    }
  }

  /// Packed codes of rgba8 of each lane's pixel. `at`: offset from the tile's first pixel. Lanes not `wanted`: any
  /// value.
  Int<R> codes(const Offset<R>& at, Mask<R> wanted) const {
    const Wide<R> q = value_at<R>(sum_, at);
    const Weights<R> all = weights<R>(to_float(value_at<R>(q1_, at)), to_float(value_at<R>(q2_, at)), to_float(q));
    const Weights<R> k{select(wanted, all.k1, R(0)), select(wanted, all.k2, R(0))};
    SurfaceAttributes<R> out;
    out.color = mean_of_lanes<R>(color_, k);
    for (const Varying v : surface_.carried) out[v] = mean_of_lanes<R>(varyings_[index_of(v)], k);
    if (surface_.texture) {
      const Color<R>& st = out[Varying::texture];
      out.texel.color = texel_color<R>(*surface_.texture, {st.r, st.g}, gradients<R>(gradients_, at, q));
    }
    return packed_merge(shade<R>(surface_, front_, out));
  }

 private:
  const Surface& surface_;
  bool front_;
  Affine<Wide<R>> q1_, q2_, sum_;
  GradientSetupOf<Wide<R>> gradients_;
  AttributeLanes<R> color_;
  std::array<AttributeLanes<R>, kVaryings> varyings_;  ///< those that the surface carries
};

}  // namespace plumbline::pipeline

// Setup of triangles for one tile, as many at a time as R has lanes: edge functions, planes, and the bounds that choose
// a fast path. paint_alone() (lone_triangle.h) sets up one triangle by the definition's functions.
#pragma once

#include "painter/painting.h"

namespace plumbline::pipeline {

/// Edge functions as 32-bit integers, counted from the tile: -1 - floor(E / 256), exact in sign because E's steps are
/// multiples of 256. E(x, y) >= 0 (coverage.h) exactly where at_tile + step_x x + step_y y < 0, so a pixel is inside
/// where the "and" of the three is negative. Values are clamped to +-2^30: |step| <= 2^22, so that 64 x 64 pixels
/// change a value by less than 2^29, and a clamped value keeps its sign. Edges longer than kLongestEdge (painting.h) do
/// not fit: they come from corners cut at a tiny w, which rounding may move far outside the frame.
inline constexpr std::int32_t kFarEdge = 1 << 30;

/// Setup of one lane's triangle. Edge functions and depth planes of a pixel's samples differ in their constant alone;
/// `at_tile` is the least of `at_sample`, so that a pixel outside by it is outside for all samples. Of the
/// FragmentSetup, depth_plane's range and perspective.inv_w are not set.
template <int kSampleCount = 1>
struct LaneSetup : FragmentSetup {
  int x0, y0, x1, y1;  ///< bounding box in the tile, [x0, x1) x [y0, y1); x0 and y0 rounded down to a block's
  std::int32_t at_tile[3], step_x[3], step_y[3];  ///< per edge
  std::int32_t at_sample[kSampleCount][3];
  Affine<double> code[kSampleCount];
  float nearest;                  ///< depth code; all fragments in the tile are farther
  bool plain_depth, plain_color;  ///< as LaneTriangles
  GradientSetup gradients;        ///< of a textured surface
};

/// Affine of each lane, in memory.
template <class R>
struct AffineLanes {
  static constexpr int kLanes = Lanes<R>::width;
  alignas(64) double at_0[kLanes];
  double x[kLanes], y[kLanes];

  void keep(const Affine<Wide<R>>& plane) { store(plane.at_0, at_0), store(plane.x, x), store(plane.y, y); }
  Affine<double> of(int lane) const { return {at_0[lane], x[lane], y[lane]}; }
  Affine<Wide<R>> of_all() const { return {Lanes<R>::load(at_0), Lanes<R>::load(x), Lanes<R>::load(y)}; }
};
/// GradientSetup of each lane, in memory.
template <class R>
struct GradientLanes {
  static constexpr int kLanes = Lanes<R>::width;
  alignas(64) double of_each[6][kLanes];
  bool any = false;  ///< the draw's surface has a texture

  void keep(const GradientSetupOf<Wide<R>>& g) {
    const Wide<R>* const each[6] = {&g.ds_dx, &g.ds_dy, &g.s_turn, &g.dt_dx, &g.dt_dy, &g.t_turn};
    for (int i = 0; i < 6; ++i) store(*each[i], of_each[i]);
  }
  GradientSetup of(int lane) const {
    const auto& e = of_each;
    return {e[0][lane], e[1][lane], e[2][lane], e[3][lane], e[4][lane], e[5][lane]};
  }
  GradientSetupOf<Wide<R>> of_all() const {
    const auto all = [&](int i) { return Lanes<R>::load(of_each[i]); };
    return {all(0), all(1), all(2), all(3), all(4), all(5)};
  }
};
/// Setup of as many triangles as there are lanes, in memory.
template <class R, int kSampleCount = 1>
struct LaneTriangles {
  static constexpr int kLanes = Lanes<R>::width;
  alignas(64) std::int32_t bounds[4][kLanes];  ///< as LaneSetup, x0 and y0 not rounded
  std::int32_t step_x[3][kLanes], step_y[3][kLanes];
  alignas(64) std::int32_t at_sample[kSampleCount][3][kLanes];
  AffineLanes<R> code[kSampleCount], q1, q2, sum;
  GradientLanes<R> gradients;
  alignas(64) float color[3][4][kLanes];  ///< corner 0's, and the others' differences from it
  float nearest[kLanes];
  alignas(64) std::int32_t constant_colors[kLanes];  ///< 1: the corners have one colour; else 0
  unsigned fitting;                                  ///< a bit per lane: no edge longer than kLongestEdge
  /// A bit per lane. plain_depth: in the tile, no depth code needs the clamp, and all are nearer than the clear depth.
  /// plain_color: in the tile, 1/w is not near 0 and weights are below 1024; all corners have the same alpha.
  unsigned plain_depth, plain_color;
  unsigned in_blocks;  ///< as PerspectiveSetup
  int width, height;   ///< greatest of the lanes' boxes [pixels]; <= 0: all are empty

  /// Setup of one lane's triangle. (tile_x, tile_y): the lower left pixel of the tile.
  [[gnu::always_inline]] LaneSetup<kSampleCount> of(int lane, bool front, int tile_x, int tile_y) const {
    LaneSetup<kSampleCount> s;
    s.front = front;
    s.anchor = {tile_x + 0.5, tile_y + 0.5};
    s.x0 = bounds[0][lane] & ~(kBlock - 1), s.y0 = bounds[1][lane] & ~(kBlock - 1);
    s.x1 = bounds[2][lane], s.y1 = bounds[3][lane];
    for (int i = 0; i < kSampleCount; ++i) s.code[i] = code[i].of(lane);
    for (int k = 0; k < 3; ++k) {
      s.step_x[k] = step_x[k][lane], s.step_y[k] = step_y[k][lane];
      s.at_tile[k] = at_sample[0][k][lane];
      for (int i = 0; i < kSampleCount; ++i) {
        s.at_sample[i][k] = at_sample[i][k][lane];
        s.at_tile[k] = std::min(s.at_tile[k], s.at_sample[i][k]);
      }
    }
    s.depth_plane.code = s.code[0];
    s.perspective.q1 = q1.of(lane), s.perspective.q2 = q2.of(lane), s.perspective.sum = sum.of(lane);
    s.perspective.in_blocks = (in_blocks >> lane & 1u) != 0;
    for (int c = 0; c < 4; ++c) {
      s.attributes.value0[c] = color[0][c][lane];
      s.attributes.delta1[c] = color[1][c][lane];
      s.attributes.delta2[c] = color[2][c][lane];
    }
    s.attributes.constant = constant_colors[lane] != 0;
    s.nearest = nearest[lane];
    s.plain_depth = (plain_depth >> lane & 1u) != 0;
    s.plain_color = (plain_color >> lane & 1u) != 0;
    if (gradients.any) s.gradients = gradients.of(lane);
    return s;
  }
};

/// Corners of the lanes' triangles, as indices of Painting::vertices: [corner][lane].
template <class R>
using CornersOfLanes = std::uint32_t[3][Lanes<R>::width];

template <class R>
struct CornerLanes {
  Vec4<R> p_win[3];
  Int<R> snapped_x[3], snapped_y[3];
};
template <class R>
[[gnu::always_inline]] inline Vec4<R> load_corner(const std::uint32_t (&corner)[Lanes<R>::width], auto member) {
  const float* from[Lanes<R>::width];
  for (int lane = 0; lane < Lanes<R>::width; ++lane) from[lane] = member(corner[lane]);
  return Lanes<R>::load_fours(from);
}
template <class R>
[[gnu::always_inline]] inline CornerLanes<R> load_corners(const Painting& painting, const CornersOfLanes<R>& corner) {
  const auto p_win = [&](std::uint32_t vertex) { return &painting.vertices[vertex].p_win.x; };
  CornerLanes<R> out;
  for (int k = 0; k < 3; ++k) {
    out.p_win[k] = load_corner<R>(corner[k], p_win);
    const auto [x, y] = Lanes<R>::load_twos([&](int lane) { return &painting.snapped[corner[k][lane]].x; });
    out.snapped_x[k] = x, out.snapped_y[k] = y;
  }
  return out;
}

/// AttributeSetup of each lane.
template <class R>
struct AttributeLanes {
  Color<R> value0, delta1, delta2;
  Mask<R> constant;
};
/// attribute_setup() per lane, of four floats per corner. member(vertex): address of the floats; `flat`: all corners
/// have those of the provoking vertex, corner 1.
template <class R>
[[gnu::always_inline]] inline AttributeLanes<R> attribute_lanes(const CornersOfLanes<R>& corner, bool flat,
                                                                auto member) {
  const auto at = [&](int k) { return load_corner<R>(corner[flat ? 1 : k], member); };
  AttributeLanes<R> out;
  out.value0 = at(0), out.delta1 = at(1) - out.value0, out.delta2 = at(2) - out.value0;
  out.constant = Lanes<R>::mask_of(~0u);
  for (int c = 0; c < 4; ++c) {
    const Mask<R> as_1 = out.delta1[c] == R(0), as_2 = out.delta2[c] == R(0);
    out.constant = out.constant & as_1 & as_2;
  }
  return out;
}

/// Sets the colours of `out`; returns the lanes whose corners have the same alpha.
template <class R, int kSampleCount>
[[gnu::always_inline]] inline Mask<R> set_up_colors(const Painting& painting, const CornersOfLanes<R>& corner,
                                                    bool flat, LaneTriangles<R, kSampleCount>& out) {
  const auto color_of = [&](std::uint32_t vertex) { return &painting.vertices[vertex].color.r; };
  const AttributeLanes<R> color = attribute_lanes<R>(corner, flat, color_of);
  for (int c = 0; c < 4; ++c) {
    store(color.value0[c], out.color[0][c]);
    store(color.delta1[c], out.color[1][c]), store(color.delta2[c], out.color[2][c]);
  }
  store(select(color.constant, Int<R>(1), Int<R>(0)), out.constant_colors);
  return (color.delta1.a == R(0)) & (color.delta2.a == R(0));
}

/// Sets the planes of `out`: depth at each sample, without polygon offset; weights at the pixel's centre.
template <class R, int kSampleCount>
[[gnu::always_inline]] inline void set_up_planes(const CornerPlanes<Wide<R>>& planes, const Vec4<R> (&p_win)[3],
                                                 const Painting& painting, LaneTriangles<R, kSampleCount>& out) {
  using W = Wide<R>;
  const auto through_corners = [&](int coordinate, double unit) {
    const W at_0 = to_wide(p_win[0][coordinate]);
    const auto beyond = [&](int k) { return (to_wide(p_win[k][coordinate]) - at_0) * unit; };
    return planes.through(at_0 * unit, beyond(1), beyond(2));
  };
  out.q1.keep(scaled(planes.l1, to_wide(p_win[1][3])));
  out.q2.keep(scaled(planes.l2, to_wide(p_win[2][3])));
  out.sum.keep(through_corners(3, 1));
  const Affine<W> code = through_corners(2, painting.formats.depth_scale == 0 ? 1 : painting.formats.depth_scale);
  for (int i = 0; i < kSampleCount; ++i) {  // at_offset(), depth.h
    Affine<W> at_sample = code;
    const glm::dvec2 by = glm::dvec2(painting.samples[static_cast<std::size_t>(i)]) / static_cast<double>(kSubpixel);
    if (by != glm::dvec2(0)) at_sample.at_0 = code.at_0 + (by.x * code.x + by.y * code.y);
    out.code[i].keep(at_sample);
  }
}

/// Sets the gradients of `out`, where the draw's surface has a texture.
template <class R, int kSampleCount>
[[gnu::always_inline]] inline void set_up_gradients(const CornersOfLanes<R>& corner,
                                                    const CornerPlanes<Wide<R>>& planes, const Vec4<R> (&p_win)[3],
                                                    const Painting& painting, const PaintDraw& draw,
                                                    LaneTriangles<R, kSampleCount>& out) {
  out.gradients.any = draw.surface != nullptr && draw.surface->texture;
  if (!out.gradients.any) return;
  const Vec4<float>* const column = painting.varyings[index_of(Varying::texture)];
  const auto texcoords = [&](std::uint32_t vertex) { return &column[vertex].x; };
  Wide<R> of_s[3], of_t[3], inv_w[3];
  for (int k = 0; k < 3; ++k) {
    const Vec4<R> st = load_corner<R>(corner[k], texcoords);
    of_s[k] = to_wide(st.x), of_t[k] = to_wide(st.y), inv_w[k] = to_wide(p_win[k][3]);
  }
  out.gradients.keep(gradient_setup<Wide<R>>(planes, of_s, of_t, inv_w));
}

/// Sets up the lanes' triangles for the tile whose lower left pixel is `tile`. `facing`: 1 of a front face, -1 of a
/// back face.
template <class R, int kSampleCount>
void set_up_lanes(const CornersOfLanes<R>& corner, const float (&facing)[Lanes<R>::width], const Painting& painting,
                  const PaintDraw& draw, glm::ivec2 tile, LaneTriangles<R, kSampleCount>& out) {
  using I = Int<R>;
  using W = Wide<R>;
  const auto& [p_win, snapped_x, snapped_y] = load_corners<R>(painting, corner);
  const Mask<R> same_alpha = set_up_colors<R>(painting, corner, draw.flat(), out);
  const R face = Lanes<R>::load(facing);
  const PlaneCorners<W> through =
      plane_corners<R>({p_win[0][0], p_win[1][0], p_win[2][0]}, {p_win[0][1], p_win[1][1], p_win[2][1]}, snapped_x,
                       snapped_y, to_wide(face));
  const CornerPlanes<W> planes = corner_planes(through, tile.x + 0.5, tile.y + 0.5);
  set_up_planes<R>(planes, p_win, painting, out);
  set_up_gradients<R>(corner, planes, p_win, painting, draw, out);
  const Affine<W> q1 = out.q1.of_all(), q2 = out.q2.of_all(), sum = out.sum.of_all();
  out.in_blocks = 0;
  if (draw.surface == nullptr && draw.kernel != PaintKernel::depth_only) {
    const W inv_w[3] = {to_wide(p_win[0][3]), to_wide(p_win[1][3]), to_wide(p_win[2][3])};
    out.in_blocks = bits_of(Mask<R>(changes_little(q1, q2, sum, inv_w)));
  }

  // Snapped corners, counted from the centre of the tile's first pixel [1/256 pixel].
  const I origin_x(tile.x * kSubpixel), origin_y(tile.y * kSubpixel);
  I x[3], y[3];
  for (int k = 0; k < 3; ++k) x[k] = snapped_x[k] - origin_x, y[k] = snapped_y[k] - origin_y;
  const auto [low_sample, high_sample] = painting.sample_bounds();
  const auto least = [](const I(&v)[3]) { return lesser_of(lesser_of(v[0], v[1]), v[2]); };
  const auto most = [](const I(&v)[3]) { return greater_of(greater_of(v[0], v[1]), v[2]); };
  const auto first = [](I low, int sample) {
    return greater_of(shifted_right<8>(low + I(kSubpixel - 1 - sample)), I(0));
  };
  const auto end = [](I high, int sample) { return lesser_of(shifted_right<8>(high - I(sample)) + I(1), I(kTile)); };
  const I x_first = first(least(x), high_sample.x), y_first = first(least(y), high_sample.y);
  const I x_end = end(most(x), low_sample.x), y_end = end(most(y), low_sample.y);
  out.width = greatest_lane(x_end - x_first);
  out.height = greatest_lane(y_end - y_first);
  store(x_first, out.bounds[0]), store(y_first, out.bounds[1]);
  store(x_end, out.bounds[2]), store(y_end, out.bounds[3]);

  // Bounds of planes over the box, from its corners. Rounding errors there and at the fragments are far below 2^-48 of
  // the sum of the terms' magnitudes; rounding to a code adds less than one code.
  const W low_x = to_wide(x_first), high_x = to_wide(x_end), low_y = to_wide(y_first), high_y = to_wide(y_end);
  const auto size = [](const W& value) { return greater_of(value, -value); };
  const auto terms = [&](const Affine<W>& f) { return size(f.at_0) + (size(f.x) + size(f.y)) * W(kTile); };
  const auto least_of = [&](const Affine<W>& f) {
    return f.at_0 + lesser_of(f.x * low_x, f.x * high_x) + lesser_of(f.y * low_y, f.y * high_y) - terms(f) * W(0x1p-48);
  };
  W least_code(0), most_code(0);
  for (int i = 0; i < kSampleCount; ++i) {
    const Affine<W> code = out.code[i].of_all();
    const W low = least_of(code), high = -least_of({-code.at_0, -code.x, -code.y});
    least_code = i == 0 ? low : lesser_of(least_code, low);
    most_code = i == 0 ? high : greater_of(most_code, high);
  }
  const W least_sum = least_of(sum);
  store(to_float(floor_of(clamped(least_code, W(0), W(painting.formats.depth_scale))) - W(1)), out.nearest);
  out.plain_depth = bits_of(Mask<R>((least_code >= W(0)) & (most_code < W(painting.clear_code() - 1))));
  const W most_weight = least_sum * W(1024);  // 255 of them are far from 2^31, too
  const W terms_1 = terms(q1), terms_2 = terms(q2);
  const Mask<R> small = (least_sum > W(0x1p-60)) & (terms_1 < most_weight) & (terms_2 < most_weight);
  out.plain_color = bits_of(small & same_alpha);

  // Corners in counter-clockwise order.
  const Mask<R> front = face > R(0);
  const I x1 = select(front, x[1], x[2]), y1 = select(front, y[1], y[2]);
  x[2] = select(front, x[2], x[1]), y[2] = select(front, y[2], y[1]);
  x[1] = x1, y[1] = y1;
  I longest(0);
  for (int k = 0; k < 3; ++k) {
    const I d_x = x[(k + 1) % 3] - x[k], d_y = y[(k + 1) % 3] - y[k];
    longest = greater_of(longest, greater_of(greater_of(d_x, I(0) - d_x), greater_of(d_y, I(0) - d_y)));
    const I step_x = I(0) - d_y;
    // owns_its_centres (edges_of, coverage.cpp): else 1 less, so that 0 is outside.
    const Mask<R> owns = (step_x > I(0)) | ((step_x == I(0)) & (d_x > I(0)));
    const W less = to_wide(select(owns, I(0), I(1)));
    const W wide_x = to_wide(d_x), wide_y = to_wide(d_y), e = wide_y * to_wide(x[k]) - wide_x * to_wide(y[k]);
    for (int i = 0; i < kSampleCount; ++i) {
      const glm::dvec2 sample(painting.samples[static_cast<std::size_t>(i)]);
      const W at_sample = e - (wide_y * sample.x - wide_x * sample.y);
      const W at_tile = floor_of((at_sample - less) * W(1.0 / kSubpixel));
      store(I(-1) - to_int(clamped(at_tile, W(-kFarEdge), W(kFarEdge))), out.at_sample[i][k]);
    }
    store(d_y, out.step_x[k]);
    store(I(0) - d_x, out.step_y[k]);
  }
  out.fitting = bits_of(longest <= I(kLongestEdge));
}

}  // namespace plumbline::pipeline

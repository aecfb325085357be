// Triangles made ready for a tile, as many at a time as R has lanes: what set_up() (fragment.h) makes of one.
#pragma once

#include "pipeline/painting.h"

namespace plumbline::pipeline {

/// An edge function in 32 bits, counted from the tile: E(x, y) >= 0 (coverage.h) exactly where at_tile + step_x x +
/// step_y y >= 0. Its steps are multiples of 256, so that of the rest its floor tells.
struct TileEdge {
  std::int32_t at_tile, step_x, step_y;
};
/// |step| <= 2^22 and 64 pixels reach less than 2^29, so that what is beyond 2^30 has a sign that no pixel of the tile
/// changes. Corners cut where w is tiny may be rounded to far outside of the frame: such edges do not fit.
inline constexpr std::int32_t kFarEdge = 1 << 30;  // (kLongestEdge: painting.h)

/// A triangle in its lane.
template <class Depth>
struct LaneSetup {
  bool front;
  int x0, y0, x1, y1;  ///< the pixels of the tile in its bounding box, x0 and y0 rounded down to a block's
  TileEdge edge[3];
  BarycentricPlanes planes;
  Depth depth;
  float nearest;  ///< a depth code: none of its fragments in the tile is nearer
  AttributeSetup attributes;
};
/// Of a draw that has a surface.
struct LaneSurfaceSetup : LaneSetup<DepthSetup> {
  const SurfaceSetup* surface;
};

template <class R>
struct SetupLanes {
  static constexpr int kLanes = Lanes<R>::width;
  alignas(64) std::int32_t bounds[4][kLanes];  ///< as LaneSetup, x0 and y0 not rounded
  alignas(64) std::int32_t at_tile[3][kLanes];
  std::int32_t step_x[3][kLanes], step_y[3][kLanes];
  alignas(64) double planes[6][kLanes];
  double depth[3][kLanes];
  alignas(64) float inv_w[3][kLanes];
  float color[3][4][kLanes];
  float nearest[kLanes];
  alignas(64) std::int32_t constant_colors[kLanes];  ///< not 0: of one colour
  unsigned fitting;                                  ///< a bit a lane
  int width, height;                                 ///< the largest box

  template <class Depth>
  [[gnu::always_inline]] LaneSetup<Depth> of(int lane) const {
    LaneSetup<Depth> s;
    s.x0 = bounds[0][lane] & ~(kBlock - 1), s.y0 = bounds[1][lane] & ~(kBlock - 1);
    s.x1 = bounds[2][lane], s.y1 = bounds[3][lane];
    for (int k = 0; k < 3; ++k) s.edge[k] = {at_tile[k][lane], step_x[k][lane], step_y[k][lane]};
    s.planes.l1_0 = planes[0][lane], s.planes.l1_x = planes[1][lane], s.planes.l1_y = planes[2][lane];
    s.planes.l2_0 = planes[3][lane], s.planes.l2_x = planes[4][lane], s.planes.l2_y = planes[5][lane];
    s.depth.z0 = depth[0][lane], s.depth.dz1 = depth[1][lane], s.depth.dz2 = depth[2][lane];
    for (int k = 0; k < 3; ++k) s.attributes.inv_w[k] = inv_w[k][lane];
    for (int c = 0; c < 4; ++c) {
      s.attributes.color0[c] = color[0][c][lane];
      s.attributes.d_color1[c] = color[1][c][lane];
      s.attributes.d_color2[c] = color[2][c][lane];
    }
    s.attributes.constant = constant_colors[lane] != 0;
    s.nearest = nearest[lane];
    return s;
  }
};

/// What is the same for all lanes.
struct SetupSite {
  int tile_x, tile_y;  ///< the tile's lower left pixel
  glm::ivec2 sample;   ///< Formats::sample
  double depth_scale;  ///< Formats::depth_scale
  bool flat;
};

/// `corner`: per corner, each lane's vertex; `facing`: 1 of a front face, -1 of a back one.
template <class R>
void set_up_lanes(const WindowVertex<float>* const (&corner)[3][Lanes<R>::width],
                  const float (&facing)[Lanes<R>::width], const SetupSite& site, SetupLanes<R>& out) {
  using I = Int<R>;
  using W = Wide<R>;
  const auto fours = [&](int k, auto member, R(&four)[4]) {
    const float* from[Lanes<R>::width];
    for (int lane = 0; lane < Lanes<R>::width; ++lane) from[lane] = member(corner[k][lane]);
    load_fours(from, four);
  };
  R p_win[3][4], color[3][4];
  I snapped_x[3], snapped_y[3];
  for (int k = 0; k < 3; ++k) {
    fours(
        k, [](const WindowVertex<float>* v) { return &v->p_win.x; }, p_win[k]);
    R four[4];
    fours(
        k, [](const WindowVertex<float>* v) { return reinterpret_cast<const float*>(&v->snapped); }, four);
    snapped_x[k] = as_int(four[0]), snapped_y[k] = as_int(four[1]);
    store(p_win[k][3], out.inv_w[k]);
  }
  for (int k = 0; k < 3; ++k)
    fours(
        site.flat ? 1 : k, [](const WindowVertex<float>* v) { return &v->color.r; }, color[k]);
  Mask<R> constant = p_win[0][0] == p_win[0][0];
  for (int c = 0; c < 4; ++c) {
    const R d1 = color[1][c] - color[0][c], d2 = color[2][c] - color[0][c];
    constant = constant & (d1 == R(0)) & (d2 == R(0));
    store(color[0][c], out.color[0][c]);
    store(d1, out.color[1][c]);
    store(d2, out.color[2][c]);
  }
  store(select(constant, I(1), I(0)), out.constant_colors);

  const R face = load<R>(facing);
  const PlaneCorners<W> through =
      plane_corners<R>({p_win[0][0], p_win[1][0], p_win[2][0]}, {p_win[0][1], p_win[1][1], p_win[2][1]}, snapped_x,
                       snapped_y, to_wide(face));
  const AffinePlanes<W> planes = planes_through(through, site.tile_x + 0.5, site.tile_y + 0.5);
  const W wide_z0 = to_wide(p_win[0][2]), dz1 = to_wide(p_win[1][2]) - wide_z0, dz2 = to_wide(p_win[2][2]) - wide_z0;
  W z0 = wide_z0;
  if (site.sample != glm::ivec2(0)) {  // moved(), depth.h; colours are the centre's
    const glm::dvec2 by = glm::dvec2(site.sample) / static_cast<double>(kSubpixel);
    z0 = z0 + ((by.x * planes.l1_x + by.y * planes.l1_y) * dz1 + (by.x * planes.l2_x + by.y * planes.l2_y) * dz2);
  }
  store(planes.l1_0, out.planes[0]), store(planes.l1_x, out.planes[1]), store(planes.l1_y, out.planes[2]);
  store(planes.l2_0, out.planes[3]), store(planes.l2_x, out.planes[4]), store(planes.l2_y, out.planes[5]);
  store(z0, out.depth[0]), store(dz1, out.depth[1]), store(dz2, out.depth[2]);

  // From here on, corners are counted from the tile, and from the sample.
  const I origin_x(site.tile_x * kSubpixel + site.sample.x), origin_y(site.tile_y * kSubpixel + site.sample.y);
  I x[3], y[3];
  for (int k = 0; k < 3; ++k) x[k] = snapped_x[k] - origin_x, y[k] = snapped_y[k] - origin_y;
  const auto least = [](const I(&v)[3]) { return lesser_of(lesser_of(v[0], v[1]), v[2]); };
  const auto most = [](const I(&v)[3]) { return greater_of(greater_of(v[0], v[1]), v[2]); };
  const auto first = [](I low) { return greater_of(shifted_right<8>(low + I(kSubpixel - 1)), I(0)); };
  const auto end = [](I high) { return lesser_of(shifted_right<8>(high) + I(1), I(kTile)); };
  const I x_first = first(least(x)), y_first = first(least(y)), x_end = end(most(x)), y_end = end(most(y));
  out.width = greatest_lane(x_end - x_first);
  out.height = greatest_lane(y_end - y_first);
  store(x_first, out.bounds[0]), store(y_first, out.bounds[1]);
  store(x_end, out.bounds[2]), store(y_end, out.bounds[3]);

  // The plane of depth at the box's nearest corner. What rounding does to it and to the fragments' depths is far below
  // 2^-48 of the terms' sum; a code's rounding, and all that is left, is below one code.
  const auto size = [](const W& value) { return greater_of(value, -value); };
  const W z_x = planes.l1_x * dz1 + planes.l2_x * dz2, z_y = planes.l1_y * dz1 + planes.l2_y * dz2;
  const W at_x = lesser_of(z_x * to_wide(x_first), z_x * to_wide(x_end));
  const W at_y = lesser_of(z_y * to_wide(y_first), z_y * to_wide(y_end));
  const W z1 = planes.l1_0 * dz1, z2 = planes.l2_0 * dz2;
  const W terms =
      size(z0) + size(z1) + size(z2) +
      (size(planes.l1_x * dz1) + size(planes.l2_x * dz2) + size(planes.l1_y * dz1) + size(planes.l2_y * dz2)) *
          W(kTile);
  const W least_z = (z0 + z1 + z2 + at_x + at_y) - terms * W(0x1p-48);
  store(to_float(floor_of(clamped(least_z, W(0), W(1)) * site.depth_scale) - W(1)), out.nearest);

  // Counter-clockwise.
  const Mask<R> front = face > R(0);
  const I x1 = select(front, x[1], x[2]), y1 = select(front, y[1], y[2]);
  x[2] = select(front, x[2], x[1]), y[2] = select(front, y[2], y[1]);
  x[1] = x1, y[1] = y1;
  I longest(0);
  for (int k = 0; k < 3; ++k) {
    const I d_x = x[(k + 1) % 3] - x[k], d_y = y[(k + 1) % 3] - y[k];
    longest = greater_of(longest, greater_of(greater_of(d_x, I(0) - d_x), greater_of(d_y, I(0) - d_y)));
    const I step_x = I(0) - d_y;
    // owns_its_centres (coverage.cpp): else 1 less, so that 0 is outside.
    const Mask<R> owns = (step_x > I(0)) | ((step_x == I(0)) & (d_x > I(0)));
    const W e = to_wide(d_y) * to_wide(x[k]) - to_wide(d_x) * to_wide(y[k]);
    const W at_tile = floor_of((e - to_wide(select(owns, I(0), I(1)))) * W(1.0 / kSubpixel));
    store(to_int(clamped(at_tile, W(-kFarEdge), W(kFarEdge))), out.at_tile[k]);
    store(step_x, out.step_x[k]);
    store(d_x, out.step_y[k]);
  }
  out.fitting = bits_of(longest <= I(kLongestEdge));
}

}  // namespace plumbline::pipeline

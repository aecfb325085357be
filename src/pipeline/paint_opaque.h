// Stages 5 to 11 of triangles whose nearer fragments replace what is there, or are blended over it, or leave their
// depth alone, without further tests, in frames of rgba8 and z24: what covered_pixels() does (fragment.h), its terms
// taken out of the loops that they do not change in.
#pragma once

#include "pipeline/visit_covered.h"

namespace plumbline::pipeline {

enum class Order { first_to_last, last_to_first };

/// A lane's triangle. `one_color`: that of a triangle that has but one.
template <class R, PaintKernel kKernel, Order kOrder, bool kOneColor>
[[gnu::always_inline]] inline void paint_opaque_triangle(const LaneSetup<Z24Setup>& s, const Color<R>& one_color,
                                                         float cleared, PackedTile& tile) {
  using W = Wide<R>;
  constexpr int kLanes = Lanes<R>::width;
  constexpr bool kFromLast = kOrder == Order::last_to_first;
  const Int<R> one_code = packed_merge(one_color);
  const BarycentricPlanes& planes = s.planes;
  // From last to first, a fragment as near as one that was painted before it comes before it; one as near as the clear
  // depth is none.
  const auto limit = [](R held) { return kFromLast ? held + R(1.0f) : held; };
  W of_row[2][kParts<R>];  // dy l1_y, dy l2_y
  const auto row = [&](int y) {
    for (int part = 0; part < kParts<R>; ++part) {
      const W dy = rows_of_block<R>(y, part * kLanes);
      of_row[0][part] = dy * planes.l1_y;
      of_row[1][part] = dy * planes.l2_y;
    }
    unsigned nearer = 0;
    for (int b = 0; b < kTile / kBlock; b += kLanes) {
      nearer |= bits_of(limit(load<R>(tile.farthest + y / kBlock * (kTile / kBlock) + b)) > R(s.nearest)) << b;
    }
    return nearer;
  };
  visit_covered<R>(s, row, [&](int x, int y, const Mask<R>(&covered)[kParts<R>]) {
    R farthest(0);
    bool full = true;
    for (int part = 0; part < kParts<R>; ++part) {
      if (!any(covered[part])) {
        full = false;
        continue;
      }
      const W dx = columns_of_block<R>(x, part * kLanes);
      const StoredCodes to = tile.at(block_offset(x, y) + part * kLanes);
      const W l1 = planes.l1_0 + (dx * planes.l1_x + of_row[0][part]),
              l2 = planes.l2_0 + (dx * planes.l2_x + of_row[1][part]);
      const Barycentric<R> b{1.0 - l1 - l2, l1, l2};
      const R z = depth<R>(s.depth, b), held = load<R>(to.depth);
      Mask<R> kept = covered[part] & (z < limit(held));
      if constexpr (kFromLast) kept = kept & (z < R(cleared));
      full = full && all(kept);
      if (!any(kept)) continue;
      farthest = greater_of(farthest, z);
      store(kept, z, to.depth);
      if constexpr (kKernel == PaintKernel::depth_alone) continue;
      const auto color = [&]() -> Color<R> {
        if constexpr (kOneColor) return one_color;
        return attributes<R>(s.attributes, b);
      };
      if constexpr (kKernel == PaintKernel::blends_over) {
        store_packed(kept, packed_over<R>(color(), load_packed<R>(to.color)), to.color);
      } else {
        store_packed(kept, kOneColor ? one_code : packed_merge(color()), to.color);
      }
    }
    if (full) tile.farthest[y / kBlock * (kTile / kBlock) + x / kBlock] = greatest_lane(farthest);
  });
}

/// Of lanes' triangles, what attributes() asks of one.
template <class R>
struct AttributeLanes {
  R inv_w[3];
  R color0[4], d_color1[4], d_color2[4];
};
template <class R>
struct Z24Lanes {
  Wide<R> z0, dz1, dz2;
  static constexpr double scale = Z24Setup::scale, low = Z24Setup::low, high = Z24Setup::high;
};

inline constexpr int kSmall = 24;  ///< pixels of a box

/// Triangles in boxes of `lanes.width` x `lanes.height` pixels, all at once: pixel by pixel of their boxes; then, one
/// after the other, what they cover into the tile.
template <class R, PaintKernel kKernel, Order kOrder>
void paint_small_triangles(const SetupLanes<R>& lanes, int count, float cleared, PackedTile& tile) {
  using I = Int<R>;
  using W = Wide<R>;
  constexpr int kLanes = Lanes<R>::width;
  alignas(64) float z_of[kSmall][kLanes];
  alignas(64) std::int32_t code_of[kSmall][kLanes], place_of[kSmall][kLanes];

  const W l1_0 = load_wide<R>(lanes.planes[0]), l1_x = load_wide<R>(lanes.planes[1]);
  const W l1_y = load_wide<R>(lanes.planes[2]), l2_0 = load_wide<R>(lanes.planes[3]);
  const W l2_x = load_wide<R>(lanes.planes[4]), l2_y = load_wide<R>(lanes.planes[5]);
  const Z24Lanes<R> depths{load_wide<R>(lanes.depth[0]), load_wide<R>(lanes.depth[1]), load_wide<R>(lanes.depth[2])};
  AttributeLanes<R> of;
  for (int k = 0; k < 3; ++k) of.inv_w[k] = load<R>(lanes.inv_w[k]);
  for (int c = 0; c < 4; ++c) {
    of.color0[c] = load<R>(lanes.color[0][c]);
    of.d_color1[c] = load<R>(lanes.color[1][c]);
    of.d_color2[c] = load<R>(lanes.color[2][c]);
  }
  const Mask<R> constant = load_ints<R>(lanes.constant_colors) != I(0);

  const I x0 = load_ints<R>(lanes.bounds[0]), y0 = load_ints<R>(lanes.bounds[1]);
  const I x1 = load_ints<R>(lanes.bounds[2]), y1 = load_ints<R>(lanes.bounds[3]);
  const Mask<R> wanted = load_ints<R>(kBlockNumbers) < I(count);
  I of_row[3], step_x[3], step_y[3];
  for (int k = 0; k < 3; ++k) {
    step_x[k] = load_ints<R>(lanes.step_x[k]), step_y[k] = load_ints<R>(lanes.step_y[k]);
    of_row[k] = load_ints<R>(lanes.at_tile[k]) + step_x[k] * x0 + step_y[k] * y0;
  }
  I seen(0);  // a bit for each of the pixels that any triangle covers
  int pixels = 0;
  for (int row = 0; row < lanes.height; ++row) {
    const I y = y0 + I(row), place_y = shifted_left<8>(shifted_right<2>(y)) + shifted_left<2>(y & I(kBlock - 1));
    const Mask<R> in_row = wanted & (y < y1);
    const W dy = to_wide(y), l1_of_row = dy * l1_y, l2_of_row = dy * l2_y;
    I e[3] = {of_row[0], of_row[1], of_row[2]};
    for (int column = 0; column < lanes.width; ++column) {
      const I x = x0 + I(column);
      const Mask<R> covered = in_row & (x < x1) & ((e[0] | e[1] | e[2]) >= I(0));
      for (int k = 0; k < 3; ++k) e[k] = e[k] + step_x[k];
      if (!any(covered)) continue;
      const W dx = to_wide(x);
      const W l1 = l1_0 + (dx * l1_x + l1_of_row), l2 = l2_0 + (dx * l2_x + l2_of_row);
      const Barycentric<R> b{1.0 - l1 - l2, l1, l2};
      store(depth<R>(depths, b), z_of[pixels]);
      if constexpr (kKernel == PaintKernel::replaces) {
        const Weights<R> k = weights<R>(of.inv_w, b);
        const Color<R> color = mean<R>(of, Weights<R>{select(constant, R(0), k.k1), select(constant, R(0), k.k2)});
        store(packed_merge(color), code_of[pixels]);
      }
      store(place_y + shifted_left<4>(shifted_right<2>(x)) + (x & I(kBlock - 1)), place_of[pixels]);
      seen = seen | select(covered, I(1 << pixels), I(0));
      ++pixels;
    }
    for (int k = 0; k < 3; ++k) of_row[k] = of_row[k] + step_y[k];
  }
  alignas(64) std::int32_t seen_of[kLanes];
  store(seen, seen_of);
  for (int lane = 0; lane < count; ++lane) {
    for (auto bits = static_cast<unsigned>(seen_of[lane]); bits != 0; bits &= bits - 1) {
      const int i = std::countr_zero(bits), place = place_of[i][lane];
      const float z = z_of[i][lane], held = tile.depth[place];
      if (kOrder == Order::last_to_first ? z <= held && z < cleared : z < held) {
        tile.depth[place] = z;
        if constexpr (kKernel == PaintKernel::replaces)
          tile.color[place] = static_cast<std::uint32_t>(code_of[i][lane]);
      }
    }
  }
}

template <class R, PaintKernel kKernel, Order kOrder>
void paint_opaque(const Painting& painting, const PaintRun& run, PackedTile& tile, auto alone) {
  const auto cleared = static_cast<float>(depth_code(painting.format.clear_depth, painting.formats.depth_scale));
  const auto together = [&](const auto& lanes, int count) {
    const int box = std::max(lanes.width, 0) * std::max(lanes.height, 0);
    if (kKernel == PaintKernel::blends_over || Lanes<R>::width == 1 || box > kSmall) return false;
    paint_small_triangles<R, kKernel, kOrder>(lanes, count, cleared, tile);
    return true;
  };
  const auto paint = [&](const PaintTriangle&, const auto& lanes, int lane) {
    const auto s = lanes.template of<Z24Setup>(lane);
    const Vec4<float>& c = s.attributes.color0;
    const Color<R> color{R(c.r), R(c.g), R(c.b), R(c.a)};
    if (kKernel == PaintKernel::depth_alone || s.attributes.constant) {
      paint_opaque_triangle<R, kKernel, kOrder, true>(s, color, cleared, tile);
    } else {
      paint_opaque_triangle<R, kKernel, kOrder, false>(s, color, cleared, tile);
    }
  };
  each_lane<R>(painting, run, kOrder == Order::last_to_first, tile.x0, tile.y0, together, alone, paint);
}

}  // namespace plumbline::pipeline

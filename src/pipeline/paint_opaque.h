// Stages 5 to 11 of triangles whose nearer fragments replace what is there, or are blended over it, or leave their
// depth alone, without further tests, in frames of rgba8 and z24: what covered_pixels() does (fragment.h), its terms
// taken out of the loops that they do not change in.
#pragma once

#include "pipeline/paint_shaded.h"
#include "pipeline/visit_covered.h"

namespace plumbline::pipeline {

inline constexpr double kMostZ24 = 16777215;  ///< the largest code

enum class Order { first_to_last, last_to_first };

/// What of a triangle needs no care (SetupLanes): nothing; its depth, and it has but one colour; its depth and colours.
enum class Plain { nothing, one_color, colors };

/// mean(), where 1/w is not near 0 and the corners have the same alpha.
template <class R>
[[gnu::always_inline]] inline Color<R> plain_color(const auto& s, const R& q1, const R& q2, const R& sum,
                                                   const R& alpha) {
  const R reciprocal = R(1) / sum;
  const Weights<R> k{q1 * reciprocal, q2 * reciprocal};
  return {mixed(s, k, 0), mixed(s, k, 1), mixed(s, k, 2), alpha};
}

/// `shaded`: ShadedPixels<R>, of PaintKernel::shades.
template <class R, PaintKernel kKernel, Order kOrder, Plain kPlain>
[[gnu::always_inline]] inline void paint_opaque_triangle(const LaneSetup& s, float cleared, PackedTile& tile,
                                                         auto& shaded) {
  using W = Wide<R>;
  constexpr int kLanes = Lanes<R>::width;
  constexpr bool kFromLast = kOrder == Order::last_to_first;
  constexpr bool kDepthFirst = kKernel == PaintKernel::depth_alone || kKernel == PaintKernel::shades;
  constexpr bool kColors = !kDepthFirst && kPlain != Plain::one_color;
  constexpr int kPlanes = kColors ? 4 : 1;
  const Affine<double>* const plane[4] = {&s.depth_plane.code, &s.perspective.q1, &s.perspective.q2,
                                          &s.perspective.sum};
  const Vec4<float>& c0 = s.attributes.color0;
  const Color<R> one_color{R(c0.r), R(c0.g), R(c0.b), R(c0.a)};
  const Int<R> one_code = packed_merge(one_color);

  bool hidden = true;
  W of_row[kPlanes][kParts<R>];
  const auto row = [&](int y) {
    unsigned nearer = 0;
    for (int b = 0; b < kTile / kBlock; b += kLanes) {
      const R farthest = load<R>(tile.farthest + y / kBlock * (kTile / kBlock) + b);
      nearer |= bits_of(farthest > R(s.nearest)) << b;
    }
    if (nearer == 0) return nearer;
    hidden = false;
    for (int part = 0; part < kParts<R>; ++part) {
      const W dy = rows_of_block<R>(y, part * kLanes);
      for (int k = 0; k < kPlanes; ++k) of_row[k][part] = plane[k]->at_0 + dy * plane[k]->y;
    }
    return nearer;
  };
  visit_covered<R>(s, row, [&](int x, int y, const Mask<R>(&covered)[kParts<R>]) {
    const StoredCodes block = tile.at(block_offset(x, y));
    W of_column[kPlanes];
    const auto value = [&](int k, int part) {  // value_at()
      if constexpr (kLanes >= kBlock) return of_row[k][part] + of_column[k];
      return of_row[k][part] + columns_of_block<R>(x, part * kLanes) * plane[k]->x;
    };
    for (int k = 0; k < kPlanes; ++k) of_column[k] = columns_of_block<R>(x, 0) * plane[k]->x;
    // From last to first, a fragment as near as one that was painted before it comes before it; one as near as the
    // clear depth is none.
    Mask<R> kept[kParts<R>], some = mask_of<R>(0), full = mask_of<R>(~0u);
    R farthest(0);
    for (int part = 0; part < kParts<R>; ++part) {
      R z;
      if constexpr (kPlain == Plain::nothing) {
        z = to_float(round_even(clamped(value(0, part), W(0), W(kMostZ24))));
      } else {
        z = to_float(nearest_int(value(0, part)));
      }
      float* const to = block.depth + part * kLanes;
      const R held = load<R>(to);
      kept[part] = covered[part] & (kFromLast ? z <= held : z < held);
      if constexpr (kFromLast && kPlain == Plain::nothing) kept[part] = kept[part] & (z < R(cleared));
      some = some | kept[part];
      full = full & kept[part];
      farthest = greater_of(farthest, z);
      store(kept[part], z, to);
    }
    if (!any(some)) return;
    for (int part = 0; part < kParts<R>; ++part) {
      if constexpr (kKernel == PaintKernel::shades) shaded.add(block_offset(x, y) + part * kLanes, kept[part]);
      if (kDepthFirst || (kLanes < kBlock && !any(kept[part]))) continue;
      std::uint32_t* const to = block.color + part * kLanes;
      const auto color = [&]() -> Color<R> {
        if constexpr (!kColors) return one_color;
        const R q1 = to_float(value(1, part)), q2 = to_float(value(2, part)), sum = to_float(value(3, part));
        if constexpr (kPlain == Plain::nothing) return mean<R>(s.attributes, weights<R>(q1, q2, sum));
        return plain_color(s.attributes, q1, q2, sum, one_color.a);
      };
      if constexpr (kKernel == PaintKernel::blends_over) {
        store_packed(kept[part], packed_over<R>(color(), load_packed<R>(to)), to);
      } else if constexpr (kPlain == Plain::one_color) {
        store_packed(kept[part], one_code, to);
      } else if constexpr (kPlain == Plain::colors) {
        store_packed(kept[part], packed_merge_near(color()), to);
      } else {
        store_packed(kept[part], packed_merge(color()), to);
      }
    }
    if (all(full)) tile.farthest[y / kBlock * (kTile / kBlock) + x / kBlock] = greatest_lane(farthest);
  });
  const bool all_blocks = s.x0 == 0 && s.y0 == 0 && s.x1 == kTile && s.y1 == kTile;
  if (hidden && all_blocks) {  // the next that it would hide are not even looked at
    tile.farthest_of_all = *std::max_element(std::begin(tile.farthest), std::end(tile.farthest));
  }
}

/// AttributeSetup, of lanes' triangles.
template <class R>
struct AttributeLanes {
  R color0[4], d_color1[4], d_color2[4];
};

inline constexpr int kSmall = 30;  ///< pixels of a box: as many bits a float's exponent tells apart

/// Triangles in boxes of `lanes.width` x `lanes.height` pixels, all at once: which pixels of their boxes they cover;
/// each one's first pixel, second and so on; then, one triangle after the other, these into the tile.
template <class R, PaintKernel kKernel, Order kOrder, bool kPlain>
void paint_small_triangles(const SetupLanes<R>& lanes, int count, float cleared, PackedTile& tile) {
  using I = Int<R>;
  using W = Wide<R>;
  constexpr int kLanes = Lanes<R>::width;

  const I x0 = load_ints<R>(lanes.bounds[0]), y0 = load_ints<R>(lanes.bounds[1]);
  const I columns = load_ints<R>(lanes.bounds[2]) - x0, rows = load_ints<R>(lanes.bounds[3]) - y0;
  const Mask<R> wanted = load_ints<R>(kBlockNumbers) < I(count);
  I e_of_row[3], step_x[3], step_y[3];
  for (int k = 0; k < 3; ++k) {
    step_x[k] = load_ints<R>(lanes.step_x[k]), step_y[k] = load_ints<R>(lanes.step_y[k]);
    e_of_row[k] = load_ints<R>(lanes.at_tile[k]) + step_x[k] * x0 + step_y[k] * y0;
  }
  I covered(0);  // a bit a pixel, row by row
  for (int row = 0, bit = 0; row < lanes.height; ++row) {
    const Mask<R> in_row = wanted & (I(row) < rows);
    I e[3] = {e_of_row[0], e_of_row[1], e_of_row[2]};
    for (int column = 0; column < lanes.width; ++column, ++bit) {
      const Mask<R> inside = in_row & (I(column) < columns) & ((e[0] & e[1] & e[2]) < I(0));
      covered = covered | select(inside, I(1 << bit), I(0));
      for (int k = 0; k < 3; ++k) e[k] = e[k] + step_x[k];
    }
    for (int k = 0; k < 3; ++k) e_of_row[k] = e_of_row[k] + step_y[k];
  }
  alignas(64) std::int32_t covered_of[kLanes];
  store(covered, covered_of);
  int most = 0;
  for (int lane = 0; lane < count; ++lane) {
    most = std::max(most, std::popcount(static_cast<unsigned>(covered_of[lane])));
  }

  const Affine<W> code = lanes.code.of_all(), q1 = lanes.q1.of_all(), q2 = lanes.q2.of_all(), sum = lanes.sum.of_all();
  AttributeLanes<R> of;
  for (int c = 0; c < 4; ++c) {
    of.color0[c] = load<R>(lanes.color[0][c]);
    of.d_color1[c] = load<R>(lanes.color[1][c]);
    of.d_color2[c] = load<R>(lanes.color[2][c]);
  }
  const Mask<R> constant = load_ints<R>(lanes.constant_colors) != I(0);
  alignas(64) float z_of[kSmall][kLanes];
  alignas(64) std::int32_t code_of[kSmall][kLanes], place_of[kSmall][kLanes];
  const I width(lanes.width), per_width((1 << 16) / lanes.width + 1);
  for (int i = 0; i < most; ++i) {
    const I rest = covered & (covered - I(1)), lowest = covered ^ rest;
    const I bit = shifted_right<23>(as_int(to_float(lowest))) - I(127);  // a float's exponent
    const I row = shifted_right<16>(bit * per_width), x = x0 + (bit - row * width), y = y0 + row;
    covered = rest;
    const W dx = to_wide(x), dy = to_wide(y);
    const auto value = [&](const Affine<W>& f) { return (f.at_0 + dy * f.y) + dx * f.x; };  // value_at()
    store(place_in_tile(x, y), place_of[i]);
    if constexpr (kPlain) {
      store(to_float(nearest_int(value(code))), z_of[i]);
    } else {
      store(to_float(round_even(clamped(value(code), W(0), W(kMostZ24)))), z_of[i]);
    }
    if constexpr (kKernel == PaintKernel::replaces) {
      const R q1_here = to_float(value(q1)), q2_here = to_float(value(q2)), sum_here = to_float(value(sum));
      if constexpr (kPlain) {
        store(packed_merge_near(plain_color(of, q1_here, q2_here, sum_here, of.color0[3])), code_of[i]);
      } else {
        const Weights<R> k = weights<R>(q1_here, q2_here, sum_here);
        const Color<R> color = mean<R>(of, Weights<R>{select(constant, R(0), k.k1), select(constant, R(0), k.k2)});
        store(packed_merge(color), code_of[i]);
      }
    }
  }
  for (int lane = 0; lane < count; ++lane) {
    const int pixels = std::popcount(static_cast<unsigned>(covered_of[lane]));
    for (int i = 0; i < pixels; ++i) {
      const int place = place_of[i][lane];
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
    if (kKernel == PaintKernel::blends_over || kKernel == PaintKernel::shades || Lanes<R>::width == 1 || box > kSmall)
      return false;
    if (box == 0) return true;
    constexpr unsigned kAll = ~0u >> (32 - Lanes<R>::width);
    if ((lanes.plain_depth & lanes.plain_color) == kAll) {
      paint_small_triangles<R, kKernel, kOrder, true>(lanes, count, cleared, tile);
    } else {
      paint_small_triangles<R, kKernel, kOrder, false>(lanes, count, cleared, tile);
    }
    return true;
  };
  const auto paint = [&](const PaintTriangle& triangle, const auto& lanes, int lane) {
    if (lanes.nearest[lane] >= tile.farthest_of_all) return;
    const LaneSetup s = lanes.of(lane, triangle.front, tile.x0, tile.y0);
    const auto as = [&]<Plain kPlain>(auto& shaded) {
      paint_opaque_triangle<R, kKernel, kOrder, kPlain>(s, cleared, tile, shaded);
    };
    const auto by_depth = [&](auto& shaded) {
      s.plain_depth ? as.template operator()<Plain::one_color>(shaded) : as.template operator()<Plain::nothing>(shaded);
    };
    if constexpr (kKernel == PaintKernel::shades) {
      ShadedPixels<R> shaded(painting, painting.draws[run.draw], triangle, s, tile);
      by_depth(shaded);
      shaded.finish();
    } else {
      int none = 0;
      if (kKernel == PaintKernel::depth_alone || s.attributes.constant) return by_depth(none);
      if (!s.plain_depth || !s.plain_color) return as.template operator()<Plain::nothing>(none);
      as.template operator()<Plain::colors>(none);
    }
  };
  each_lane<R>(painting, run, kOrder == Order::last_to_first, tile.x0, tile.y0, together, alone, paint);
}

}  // namespace plumbline::pipeline

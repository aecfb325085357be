// Stages 5 to 11 of triangles whose nearer fragments replace what is there, or are blended over it, or leave their
// depth alone, without further tests, in frames of rgba8 and z24: what covered_pixels() does (fragment.h), its terms
// taken out of the loops that they do not change in.
#pragma once

#include "pipeline/paint_pixels.h"
#include "pipeline/paint_shaded.h"
#include "pipeline/visit_covered.h"

namespace plumbline::pipeline {

enum class Order { first_to_last, last_to_first };

/// What of a triangle needs no care (SetupLanes): nothing; its depth, and it has but one colour; its depth and colours.
enum class Plain { nothing, one_color, colors };

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

inline constexpr int kSmall = 30;  ///< pixels of a box: as many bits a float's exponent tells apart

/// Triangles in boxes of `lanes.width` x `lanes.height` pixels, all at once: which pixels of their boxes they cover,
/// and these (paint_pixels.h).
template <class R, PaintKernel kKernel, Order kOrder, bool kPlain>
void paint_small_triangles(const SetupLanes<R>& lanes, int count, float cleared, PackedTile& tile) {
  using I = Int<R>;
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

  PixelsOfLanes<R, kKernel == PaintKernel::replaces, kPlain, kSmall> values(lanes);
  const I width(lanes.width), per_width((1 << 16) / lanes.width + 1);
  for (int i = 0; i < most; ++i) {
    const I rest = covered & (covered - I(1)), lowest = covered ^ rest;
    const I bit = shifted_right<23>(as_int(to_float(lowest))) - I(127);  // a float's exponent
    const I row = shifted_right<16>(bit * per_width);
    values.work_out(i, x0 + (bit - row * width), y0 + row);
    covered = rest;
  }
  for (int lane = 0; lane < count; ++lane) {
    values.paint(lane, std::popcount(static_cast<unsigned>(covered_of[lane])), kOrder == Order::last_to_first, cleared,
                 tile);
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

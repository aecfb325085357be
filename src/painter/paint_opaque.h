// Stages 5 to 11 of triangles whose nearer fragments replace what is there, or are blended over it, or leave their
// depth alone, without further tests, in frames of rgba8 and z24: what paint_fragments() does (fragments.h), its terms
// taken out of the loops that they do not change in.
#pragma once

#include <array>

#include "painter/paint_pixels.h"
#include "painter/paint_shaded.h"
#include "painter/visit_covered.h"

namespace plumbline::pipeline {

enum class Order { first_to_last, last_to_first };

/// What of a triangle needs no care (SetupLanes): nothing; its depth, and it has but one colour; its depth and colours.
enum class Plain { nothing, one_color, colors };

/// `tiles`: of each sample one; `shaded`: ShadedPixels, of PaintKernel::shades.
template <class R, PaintKernel kKernel, Order kOrder, Plain kPlain, int kSampleCount>
[[gnu::always_inline]] inline void paint_opaque_triangle(const LaneSetup<kSampleCount>& s, float cleared,
                                                         PackedTile* tiles, auto& shaded) {
  using W = Wide<R>;
  constexpr int kLanes = Lanes<R>::width;
  constexpr bool kFromLast = kOrder == Order::last_to_first;
  constexpr bool kDepthFirst = kKernel == PaintKernel::depth_alone || kKernel == PaintKernel::shades;
  constexpr bool kColors = !kDepthFirst && kPlain != Plain::one_color;
  const Vec4<float>& c0 = s.attributes.color0;
  const Color<R> one_color{R(c0.r), R(c0.g), R(c0.b), R(c0.a)};
  const Int<R> one_code = packed_merge(one_color);

  constexpr int kPlanes = kSampleCount + (kColors ? 3 : 0);  // the samples' depths, and the weights
  const Affine<double>* plane[kSampleCount + 3];
  for (int i = 0; i < kSampleCount; ++i) plane[i] = &s.code[i];
  plane[kSampleCount] = &s.perspective.q1, plane[kSampleCount + 1] = &s.perspective.q2,
  plane[kSampleCount + 2] = &s.perspective.sum;

  bool hidden = true;
  W of_row[kPlanes][kParts<R>];
  const auto row = [&](int y) {
    unsigned nearer = 0;
    for (int b = 0; b < kTile / kBlock; b += kLanes) {
      Mask<R> some = mask_of<R>(0);
      for (int i = 0; i < kSampleCount; ++i) {
        some = some | (load<R>(tiles[i].farthest + y / kBlock * (kTile / kBlock) + b) > R(s.nearest));
      }
      nearer |= bits_of(some) << b;
    }
    if (nearer == 0) return nearer;
    hidden = false;
    for (int part = 0; part < kParts<R>; ++part) {
      const W dy = rows_of_block<R>(y, part * kLanes);
      for (int k = 0; k < kPlanes; ++k) of_row[k][part] = plane[k]->at_0 + dy * plane[k]->y;
    }
    return nearer;
  };
  visit_covered<R, kSampleCount>(s, row, [&](int x, int y, const Mask<R>(&covered)[kSampleCount][kParts<R>]) {
    const int place = block_offset(x, y);
    W of_column[kPlanes];
    for (int k = kSampleCount - 1; k < kPlanes; ++k) of_column[k] = columns_of_block<R>(x, 0) * plane[k]->x;
    const auto value = [&](int k, int part) {  // value_at(); all depths have the same slopes
      const int slope = k < kSampleCount ? kSampleCount - 1 : k;
      if constexpr (kLanes >= kBlock) return of_row[k][part] + of_column[slope];
      return of_row[k][part] + columns_of_block<R>(x, part * kLanes) * plane[slope]->x;
    };
    // From last to first, a fragment as near as one that was painted before it comes before it; one as near as the
    // clear depth is none.
    std::array<Mask<R>, kSampleCount> kept[kParts<R>];
    Mask<R> some = mask_of<R>(0), full[kSampleCount];
    R farthest[kSampleCount];
    for (int i = 0; i < kSampleCount; ++i) {
      full[i] = mask_of<R>(~0u), farthest[i] = R(0);
      for (int part = 0; part < kParts<R>; ++part) {
        R z;
        if constexpr (kPlain == Plain::nothing) {
          z = to_float(round_even(clamped(value(i, part), W(0), W(kMostZ24))));
        } else {
          z = to_float(nearest_int(value(i, part)));
        }
        float* const to = tiles[i].depth + place + part * kLanes;
        const R held = load<R>(to);
        Mask<R>& here = kept[part][static_cast<std::size_t>(i)];
        here = covered[i][part] & (kFromLast ? z <= held : z < held);
        if constexpr (kFromLast && kPlain == Plain::nothing) here = here & (z < R(cleared));
        some = some | here;
        full[i] = full[i] & here;
        farthest[i] = greater_of(farthest[i], z);
        store(here, z, to);
      }
    }
    if (!any(some)) return;
    for (int part = 0; part < kParts<R>; ++part) {
      if constexpr (kKernel == PaintKernel::shades) shaded.add(place + part * kLanes, kept[part]);
      if constexpr (!kDepthFirst) {
        if (kSampleCount == 1 && kLanes < kBlock && !any(kept[part][0])) continue;
        const auto color = [&]() -> Color<R> {
          if constexpr (!kColors) return one_color;
          const auto weight = [&](int k) { return to_float(value(kSampleCount + k, part)); };
          const R q1 = weight(0), q2 = weight(1), sum = weight(2);
          if constexpr (kPlain == Plain::nothing) return mean<R>(s.attributes, weights<R>(q1, q2, sum));
          return plain_color(s.attributes, q1, q2, sum, one_color.a);
        };
        const auto store_each = [&](auto codes) {
          for (int i = 0; i < kSampleCount; ++i) {
            std::uint32_t* const to = tiles[i].color + place + part * kLanes;
            store_packed(kept[part][static_cast<std::size_t>(i)], codes(to), to);
          }
        };
        if constexpr (kKernel == PaintKernel::blends_over) {
          const Color<R> over = color();
          store_each([&](const std::uint32_t* held) { return packed_over<R>(over, load_packed<R>(held)); });
        } else {
          const auto merged = [&] {
            if constexpr (kPlain == Plain::one_color) return one_code;
            if constexpr (kPlain == Plain::colors) return packed_merge_near(color());
            return packed_merge(color());
          };
          const Int<R> codes = merged();
          store_each([&](const std::uint32_t*) { return codes; });
        }
      }
    }
    for (int i = 0; i < kSampleCount; ++i) {
      if (all(full[i])) {
        tiles[i].farthest[y / kBlock * (kTile / kBlock) + x / kBlock] = greatest_lane(farthest[i]);
      }
    }
  });
  const bool all_blocks = s.x0 == 0 && s.y0 == 0 && s.x1 == kTile && s.y1 == kTile;
  for (int i = 0; i < kSampleCount && hidden && all_blocks;
       ++i) {  // the next that it would hide are not even looked at
    PackedTile& tile = tiles[i];
    tile.farthest_of_all = *std::max_element(std::begin(tile.farthest), std::end(tile.farthest));
  }
}

inline constexpr int kSmall = 30;  ///< pixels of a box: as many bits a float's exponent tells apart

/// Triangles in boxes of `lanes.width` x `lanes.height` pixels, all at once: which pixels of their boxes they cover,
/// and these (paint_pixels.h).
template <class R, PaintKernel kKernel, Order kOrder, bool kPlain>
void paint_small_triangles(const CommonLanes<R>& lanes, const SampleLanes<R>& sample, int count, float cleared,
                           PackedTile& tile) {
  using I = Int<R>;
  constexpr int kLanes = Lanes<R>::width;

  const I x0 = load_ints<R>(lanes.bounds[0]), y0 = load_ints<R>(lanes.bounds[1]);
  const I columns = load_ints<R>(lanes.bounds[2]) - x0, rows = load_ints<R>(lanes.bounds[3]) - y0;
  const Mask<R> wanted = load_ints<R>(kBlockNumbers) < I(count);
  I e_of_row[3], step_x[3], step_y[3];
  for (int k = 0; k < 3; ++k) {
    step_x[k] = load_ints<R>(lanes.step_x[k]), step_y[k] = load_ints<R>(lanes.step_y[k]);
    e_of_row[k] = load_ints<R>(sample.at_tile[k]) + step_x[k] * x0 + step_y[k] * y0;
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

  PixelsOfLanes<R, kKernel == PaintKernel::replaces, kPlain, kSmall> values(lanes, sample.code);
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

template <class R, PaintKernel kKernel, Order kOrder, int kSampleCount>
void paint_opaque(const Painting& painting, const PaintRun& run, PackedTile* tiles, auto alone) {
  const int x0 = tiles[0].x0, y0 = tiles[0].y0;
  const auto cleared = static_cast<float>(depth_code(painting.format.clear_depth, painting.formats.depth_scale));
  const auto together = [&](const auto& lanes, int count) {
    const int box = std::max(lanes.width, 0) * std::max(lanes.height, 0);
    if (kKernel == PaintKernel::blends_over || kKernel == PaintKernel::shades || Lanes<R>::width == 1 || box > kSmall)
      return false;
    if (box == 0) return true;
    constexpr unsigned kAll = ~0u >> (32 - Lanes<R>::width);
    for (int i = 0; i < kSampleCount; ++i) {
      if ((lanes.plain_depth & lanes.plain_color) == kAll) {
        paint_small_triangles<R, kKernel, kOrder, true>(lanes, lanes.sample[i], count, cleared, tiles[i]);
      } else {
        paint_small_triangles<R, kKernel, kOrder, false>(lanes, lanes.sample[i], count, cleared, tiles[i]);
      }
    }
    return true;
  };
  const auto paint = [&](const PaintTriangle& triangle, const auto& lanes, int lane) {
    bool hidden = true;
    for (int i = 0; i < kSampleCount; ++i) hidden &= lanes.nearest[lane] >= tiles[i].farthest_of_all;
    if (hidden) return;
    const LaneSetup<kSampleCount> s = lanes.of(lane, triangle.front, x0, y0);
    const auto as = [&]<Plain kPlain>(auto& shaded) {
      paint_opaque_triangle<R, kKernel, kOrder, kPlain, kSampleCount>(s, cleared, tiles, shaded);
    };
    const auto by_depth = [&](auto& shaded) {
      s.plain_depth ? as.template operator()<Plain::one_color>(shaded) : as.template operator()<Plain::nothing>(shaded);
    };
    if constexpr (kKernel == PaintKernel::shades) {
      ShadedPixels<R, kSampleCount> shaded(painting, painting.draws[run.draw], triangle, s, tiles);
      by_depth(shaded);
      shaded.finish();
    } else {
      int none = 0;
      if (kKernel == PaintKernel::depth_alone || s.attributes.constant) return by_depth(none);
      if (!s.plain_depth || !s.plain_color) return as.template operator()<Plain::nothing>(none);
      as.template operator()<Plain::colors>(none);
    }
  };
  each_lane<R, kSampleCount>(painting, run, kOrder == Order::last_to_first, x0, y0, together, alone, paint);
}

}  // namespace plumbline::pipeline

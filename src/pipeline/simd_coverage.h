// Stage 5 by SIMD: edge functions in 32 bits, counted from the tile, whole blocks told apart first.
#pragma once

#include <algorithm>

#include "pipeline/simd.h"
#include "pipeline/tiles.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {

// E(x, y) >= 0 exactly where at_tile + step_x x + step_y y >= 0, x and y counted from the tile: steps are multiples of
// 256, so that of the rest its floor tells. |step| <= 2^22 and 64 pixels reach less than 2^29, so that what is beyond
// 2^30 has a sign that no pixel of the tile changes.
struct TileEdge {
  std::int32_t at_tile, step_x, step_y;
};
inline TileEdge tile_edge(const Edges& e, int i, const Tile& tile) {
  constexpr std::int64_t kFar = std::int64_t{1} << 30;
  const std::int64_t at_tile = (e.at_origin[i] + e.step_x[i] * tile.x0 + e.step_y[i] * tile.y0) >> 8;
  return {static_cast<std::int32_t>(at_tile < -kFar  ? -kFar
                                    : at_tile > kFar ? kFar
                                                     : at_tile),
          static_cast<std::int32_t>(e.step_x[i] >> 8), static_cast<std::int32_t>(e.step_y[i] >> 8)};
}

// Corners cut where w is tiny may be rounded to far outside of the frame: such edges' steps do not fit.
inline bool fits(const Edges& e) {
  constexpr std::int64_t kMost = std::int64_t{1} << 30;  // 2^22 pixels' 256ths, times 256
  bool out = true;
  for (int k = 0; k < 3; ++k) {
    out &= e.step_x[k] >= -kMost && e.step_x[k] <= kMost && e.step_y[k] >= -kMost && e.step_y[k] <= kMost;
  }
  return out;
}

// Of such, pixel by pixel in 64 bits.
inline SimdMask far_coverage(const Edges& e, int block_x, int block_y, int i) {
  HWY_ALIGN std::int32_t lanes[kWidth];
  for (int k = 0; k < kWidth; ++k) {
    lanes[k] = pipeline::coverage<float>(e, block_pixels<float>(block_x, block_y, i + k)) ? 1 : 0;
  }
  return SimdInt(hn::Load(kInts, lanes)) > SimdInt(0);
}

}  // namespace PLUMBLINE_TARGET

template <>
struct CoveredPixels<PLUMBLINE_TARGET::Simd> {
  template <class Stages>
  [[gnu::flatten]] static void visit(const Stages&, const SetupOf<Stages>& s, const Tile& tile, auto visit) {
    using namespace PLUMBLINE_TARGET;
    constexpr int kParts = kBlockPixels / kWidth;
    const int x0 = (std::max(s.bounds.x0, tile.x0) & ~(kBlock - 1)) - tile.x0,
              x1 = std::min(s.bounds.x1 - tile.x0, kTile);
    const int y0 = (std::max(s.bounds.y0, tile.y0) & ~(kBlock - 1)) - tile.y0,
              y1 = std::min(s.bounds.y1 - tile.y0, kTile);
    if (x0 >= x1 || y0 >= y1) return;
    if (!fits(s.edges)) {
      for (int y = tile.y0 + y0; y < tile.y0 + y1; y += kBlock) {
        for (int x = tile.x0 + x0; x < tile.x0 + x1; x += kBlock) {
          for (int i = 0; i < kBlockPixels; i += kWidth) {
            const SimdMask covered = far_coverage(s.edges, x, y, i);
            if (any(covered)) visit(block_pixels<Simd>(x, y, i), covered, tile.offset(x, y) + i);
          }
        }
      }
      return;
    }
    TileEdge edge[3];
    SimdInt in_block[3][kParts];  // what E adds to that of the block's first pixel
    std::int32_t least[3], most[3];
    for (int k = 0; k < 3; ++k) {
      edge[k] = tile_edge(s.edges, k, tile);
      const std::int32_t across = (kBlock - 1) * edge[k].step_x, up = (kBlock - 1) * edge[k].step_y;
      least[k] = (across < 0 ? across : 0) + (up < 0 ? up : 0);
      most[k] = (across > 0 ? across : 0) + (up > 0 ? up : 0);
      for (int part = 0; part < kParts; ++part) {
        const SimdInt number(hn::Iota(kInts, part * kWidth));
        in_block[k][part] = (number & SimdInt(kBlock - 1)) * SimdInt(edge[k].step_x) +
                            SimdInt(hn::ShiftRight<2>(number.v)) * SimdInt(edge[k].step_y);
      }
    }
    for (int y = y0; y < y1; y += kBlock) {
      for (int x = x0; x < x1; x += kBlock) {
        std::int32_t at[3];
        bool outside = false, inside = true;
        for (int k = 0; k < 3; ++k) {
          at[k] = edge[k].at_tile + edge[k].step_x * x + edge[k].step_y * y;
          outside |= at[k] + most[k] < 0;
          inside &= at[k] + least[k] >= 0;
        }
        if (outside) continue;
        const int place = (y / kBlock * (kTile / kBlock) + x / kBlock) * kBlockPixels;
        for (int part = 0; part < kParts; ++part) {
          const SimdInt sign = (SimdInt(at[0]) + in_block[0][part]) | (SimdInt(at[1]) + in_block[1][part]) |
                               (SimdInt(at[2]) + in_block[2][part]);
          const SimdMask covered = sign >= SimdInt(0);
          if (inside || any(covered)) {
            visit(block_pixels<Simd>(tile.x0 + x, tile.y0 + y, part * kWidth), covered, place + part * kWidth);
          }
        }
      }
    }
  }
};

}  // namespace plumbline::pipeline

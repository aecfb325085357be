// Which blocks of the tile a triangle covers, and a run of triangles lane by lane.
#pragma once

#include <algorithm>
#include <bit>

#include "painter/set_up_lanes.h"

namespace plumbline::pipeline {

template <class R>
inline constexpr int kParts = kBlockPixels / Lanes<R>::width;  ///< of a block

alignas(64) inline constexpr std::int32_t kColumnInBlock[] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) inline constexpr std::int32_t kRowInBlock[] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) inline constexpr std::int32_t kBlockNumbers[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// Calls block(x, y, for each sample which pixels of each part) for the blocks with pixels inside of all three edges,
/// by rows; x, y: the block's first pixel, from the tile's. row(y), before each row: a bit for each of its sixteen
/// blocks that matter.
template <class R, int kSampleCount>
[[gnu::always_inline]] inline void visit_covered(const LaneSetup<kSampleCount>& s, auto row, auto block) {
  using I = Int<R>;
  constexpr int kLanes = Lanes<R>::width;
  I in_block[kSampleCount][3][kParts<R>];  // what E adds to that of the block's first pixel
  I of_blocks[3], least[3];  // of blocks side by side, from the row's first; and the least that it adds in a block
  for (int k = 0; k < 3; ++k) {
    const TileEdge& e = s.edge[k];
    for (int part = 0; part < kParts<R>; ++part) {
      const I within = load_ints<R>(kColumnInBlock + part * kLanes) * I(e.step_x) +
                       load_ints<R>(kRowInBlock + part * kLanes) * I(e.step_y);
      for (int i = 0; i < kSampleCount; ++i) {
        in_block[i][k][part] = kSampleCount == 1 ? within : within + I(s.at_tile[i][k] - e.at_tile);
      }
    }
    of_blocks[k] = load_ints<R>(kBlockNumbers) * I(kBlock * e.step_x) + I(e.at_tile);
    least[k] = I((kBlock - 1) * ((e.step_x < 0 ? e.step_x : 0) + (e.step_y < 0 ? e.step_y : 0)));
  }
  for (int y = s.y0; y < s.y1; y += kBlock) {
    const unsigned wanted = row(y);
    if (wanted == 0) continue;
    for (int x = s.x0; x < s.x1; x += kBlock * kLanes) {
      const int left = (s.x1 - x + kBlock - 1) / kBlock;
      alignas(64) std::int32_t at[3][kLanes];
      I some(-1);
      for (int k = 0; k < 3; ++k) {
        const I here = of_blocks[k] + I(s.edge[k].step_x * x + s.edge[k].step_y * y);
        store(here, at[k]);
        some = some & (here + least[k]);
      }
      unsigned blocks = (left < kLanes ? (1u << left) - 1 : ~0u >> (32 - kLanes)) & wanted >> (x / kBlock);
      for (blocks &= bits_of(some < I(0)); blocks != 0; blocks &= blocks - 1) {
        const int b = std::countr_zero(blocks);
        const I e[3] = {I(at[0][b]), I(at[1][b]), I(at[2][b])};
        Mask<R> covered[kSampleCount][kParts<R>], any_covered = mask_of<R>(0);
        for (int i = 0; i < kSampleCount; ++i) {
          const auto& in = in_block[i];
          for (int part = 0; part < kParts<R>; ++part) {
            covered[i][part] = ((e[0] + in[0][part]) & (e[1] + in[1][part]) & (e[2] + in[2][part])) < I(0);
            any_covered = any_covered | covered[i][part];
          }
        }
        if (any(any_covered)) block(x + kBlock * b, y, covered);
      }
    }
  }
}

/// Sets the run's triangles up, as many at a time as there are lanes; then, in their order (or the other way round),
/// calls together(lanes, how many) where all fit lanes, and if that does not paint them, paint(triangle, lanes, lane)
/// for each, or alone(triangle) for those that do not fit.
template <class R, int kSampleCount>
[[gnu::always_inline]] inline void each_lane(const Painting& painting, const PaintRun& run, bool from_last, int tile_x,
                                             int tile_y, auto together, auto alone, auto paint) {
  constexpr std::size_t kLanes = Lanes<R>::width;
  const SetupSite site = site_of(painting, run, tile_x, tile_y);
  const std::size_t size = run.numbers.size();
  SetupLanes<R, kSampleCount> lanes;
  for (std::size_t i = 0; i < size; i += kLanes) {
    const std::size_t count = std::min(kLanes, size - i);
    const auto triangle = [&](std::size_t lane) -> const PaintTriangle& {  // lanes that are too many do as the last
      const std::size_t n = i + std::min(lane, count - 1);
      return run.triangles[run.numbers[from_last ? size - 1 - n : n]];
    };
    const PaintVertex* corner[3][kLanes];
    alignas(64) float facing[kLanes];
    bool thin = false;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const PaintTriangle& t = triangle(lane);
      for (std::size_t k = 0; k < 3; ++k) corner[k][lane] = painting.vertices + t.corner[k];
      facing[lane] = t.front ? 1.0f : -1.0f;
      thin |= t.corners < 3;
    }
    lanes.fitting = 0;
    if (!thin) set_up_lanes<R, kSampleCount>(corner, facing, site, lanes);
    if (lanes.fitting == ~0u >> (32 - kLanes) && together(lanes, static_cast<int>(count))) continue;
    for (std::size_t lane = 0; lane < count; ++lane) {
      if ((lanes.fitting >> lane & 1u) != 0) {
        paint(triangle(lane), lanes, static_cast<int>(lane));
      } else {
        alone(triangle(lane));
      }
    }
  }
}

}  // namespace plumbline::pipeline

// Blocks of the tile that a triangle covers, and a run of triangles lanes by lanes.
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
    for (int part = 0; part < kParts<R>; ++part) {
      const I within = Lanes<R>::load(kColumnInBlock + part * kLanes) * I(s.step_x[k]) +
                       Lanes<R>::load(kRowInBlock + part * kLanes) * I(s.step_y[k]);
      for (int i = 0; i < kSampleCount; ++i) {
        in_block[i][k][part] = kSampleCount == 1 ? within : within + I(s.at_sample[i][k] - s.at_tile[k]);
      }
    }
    of_blocks[k] = Lanes<R>::load(kBlockNumbers) * I(kBlock * s.step_x[k]) + I(s.at_tile[k]);
    least[k] = I((kBlock - 1) * (std::min(s.step_x[k], 0) + std::min(s.step_y[k], 0)));
  }
  for (int y = s.y0; y < s.y1; y += kBlock) {
    const unsigned wanted = row(y);
    if (wanted == 0) continue;
    for (int x = s.x0; x < s.x1; x += kBlock * kLanes) {
      const int left = (s.x1 - x + kBlock - 1) / kBlock;
      alignas(64) std::int32_t at[3][kLanes];
      I some(-1);
      for (int k = 0; k < 3; ++k) {
        const I here = of_blocks[k] + I(s.step_x[k] * x + s.step_y[k] * y);
        store(here, at[k]);
        some = some & (here + least[k]);
      }
      unsigned blocks = (left < kLanes ? (1u << left) - 1 : ~0u >> (32 - kLanes)) & wanted >> (x / kBlock);
      for (blocks &= bits_of(some < I(0)); blocks != 0; blocks &= blocks - 1) {
        const int b = std::countr_zero(blocks);
        const I e[3] = {I(at[0][b]), I(at[1][b]), I(at[2][b])};
        Mask<R> covered[kSampleCount][kParts<R>], any_covered = Lanes<R>::mask_of(0);
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

/// The primitives of a run, as many at a time as there are lanes: `while (next())`, those of `corner`.
template <class R, int kSampleCount>
class LanesOfRun {
 public:
  LanesOfRun(const Painting& painting, const PaintRun& run, bool from_last, int tile_x, int tile_y)
      : painting_(painting), run_(run), from_last_(from_last), tile_(tile_x, tile_y) {}

  [[gnu::always_inline]] bool next() {
    begin_ += static_cast<std::size_t>(count);
    if (begin_ >= run_.numbers.size()) return false;
    count = static_cast<int>(std::min(kLanes, run_.numbers.size() - begin_));
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const PaintTriangle& t = in_lane(lane);
      for (std::size_t k = 0; k < 3; ++k) corner[k][lane] = painting_.vertices + t.corner[k];
    }
    return true;
  }
  /// Makes `lanes` of them, if all are triangles; else none fits.
  [[gnu::always_inline]] void set_up() {
    alignas(64) float facing[kLanes];
    bool triangles_alone = true;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const PaintTriangle& t = in_lane(lane);
      facing[lane] = t.front ? 1.0f : -1.0f;
      triangles_alone &= t.corners == 3;
    }
    lanes.fitting = 0;
    if (triangles_alone)
      set_up_lanes<R, kSampleCount>(corner, facing, painting_, painting_.draws[run_.draw].flat(), tile_, lanes);
  }
  const PaintTriangle& triangle(int lane) const {
    const std::size_t n = begin_ + static_cast<std::size_t>(lane);
    return run_.triangles[run_.numbers[from_last_ ? run_.numbers.size() - 1 - n : n]];
  }
  bool fits(int lane) const { return (lanes.fitting >> lane & 1u) != 0; }
  bool all_fit() const { return lanes.fitting == ~0u >> (32 - kLanes); }

  const PaintVertex* corner[3][Lanes<R>::width];
  LaneTriangles<R, kSampleCount> lanes;
  int count = 0;  ///< of lanes that hold a primitive

 private:
  static constexpr std::size_t kLanes = Lanes<R>::width;
  // Lanes that are too many do as the last.
  const PaintTriangle& in_lane(std::size_t lane) const { return triangle(std::min(static_cast<int>(lane), count - 1)); }

  const Painting& painting_;
  const PaintRun& run_;
  bool from_last_;
  glm::ivec2 tile_;  // its lower left pixel
  std::size_t begin_ = 0;
};

}  // namespace plumbline::pipeline

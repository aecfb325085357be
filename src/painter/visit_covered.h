// Iteration: over the blocks of a tile that a triangle covers, and over a run's triangles, a group of lanes at a time.
#pragma once

#include <algorithm>
#include <bit>
#include <type_traits>

#include "painter/set_up_lanes.h"

namespace plumbline::pipeline {

template <class R>
inline constexpr int kParts = kBlockPixels / Lanes<R>::width;  ///< vectors of a block's pixels

alignas(64) inline constexpr std::int32_t kColumnInBlock[] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
alignas(64) inline constexpr std::int32_t kRowInBlock[] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) inline constexpr std::int32_t kBlockNumbers[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
// Row of a block in a group of 2^i columns, whose blocks are numbered row by row: [i][block] = block >> i.
alignas(64) inline constexpr std::int32_t kBlockRows[][16] = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
                                                              {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6, 7, 7},
                                                              {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3},
                                                              {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1, 1},
                                                              {}};

/// Blocks that are tested together, one a lane: one row of blocks, or several shorter rows where the box is narrow.
template <class R>
struct BlockGroup {
  static constexpr int kLanes = Lanes<R>::width;
  static constexpr int kMostBits = std::countr_zero(static_cast<unsigned>(kLanes));

  explicit BlockGroup(int box_width) {
    while (bits < kMostBits && kBlock << bits < box_width) ++bits;
  }
  int columns() const { return 1 << bits; }
  int rows() const { return kLanes >> bits; }
  /// First pixel of a lane's block, counted from the group's first pixel.
  int x(int lane) const { return kBlock * (lane & (columns() - 1)); }
  int y(int lane) const { return kBlock * (lane >> bits); }
  Int<R> x() const { return shifted_left<2>(Lanes<R>::load(kBlockNumbers) & Int<R>(columns() - 1)); }
  Int<R> y() const { return shifted_left<2>(Lanes<R>::load(kBlockRows[bits])); }

  int bits = std::min(kMostBits, 2);  ///< log2 of columns()
};

/// Calls block(x, y, lane, covered, whole) for each block with pixels inside all three edges, group by group, in each
/// group whole blocks first. (x, y): the block's first pixel, counted from the tile. `lane`: its lane in the group.
/// `covered`: masks of the block's parts, for each sample. `whole`: std::true_type where all pixels are covered (only
/// with one sample), else std::false_type. Before a row of blocks, calls wanted(y), which returns a bit for each of the
/// row's 16 blocks to test. Before the blocks of a group, calls ahead(x, y, group, whether any block is whole) with the
/// first pixel of the group.
template <class R, int kSampleCount>
[[gnu::always_inline]] inline void visit_covered(const LaneSetup<kSampleCount>& s, auto wanted, auto ahead,
                                                 auto block) {
  using I = Int<R>;
  constexpr int kLanes = Lanes<R>::width;
  const BlockGroup<R> group(s.x1 - s.x0);
  I in_block[kSampleCount][3][kParts<R>];  // E at a pixel less E at its block's first pixel
  I of_blocks[3];                          // E at the first pixels of a group's blocks, the group at the tile's corner
  I least[3], greatest[3];                 // least and greatest change of E within a block
  for (int k = 0; k < 3; ++k) {
    for (int part = 0; part < kParts<R>; ++part) {
      const I within = Lanes<R>::load(kColumnInBlock + part * kLanes) * I(s.step_x[k]) +
                       Lanes<R>::load(kRowInBlock + part * kLanes) * I(s.step_y[k]);
      for (int i = 0; i < kSampleCount; ++i) {
        in_block[i][k][part] = kSampleCount == 1 ? within : within + I(s.at_sample[i][k] - s.at_tile[k]);
      }
    }
    of_blocks[k] = group.x() * I(s.step_x[k]) + I(s.at_tile[k]);
    if (group.rows() > 1) of_blocks[k] = of_blocks[k] + group.y() * I(s.step_y[k]);
    least[k] = I((kBlock - 1) * (std::min(s.step_x[k], 0) + std::min(s.step_y[k], 0)));
    greatest[k] = I((kBlock - 1) * (std::max(s.step_x[k], 0) + std::max(s.step_y[k], 0)));
  }
  for (int y = s.y0; y < s.y1; y += kBlock * group.rows()) {
    unsigned rows[kLanes];
    unsigned some_wanted = 0;
    const int row_count = std::min(group.rows(), (s.y1 - y + kBlock - 1) / kBlock);
    for (int r = 0; r < row_count; ++r) some_wanted |= rows[r] = wanted(y + kBlock * r);
    if (some_wanted == 0) continue;
    for (int x = s.x0; x < s.x1; x += kBlock * group.columns()) {
      const int left = std::min(group.columns(), (s.x1 - x + kBlock - 1) / kBlock);
      unsigned blocks = 0;
      for (int r = 0; r < row_count; ++r) blocks |= (rows[r] >> (x / kBlock) & ~0u >> (32 - left)) << (r << group.bits);
      alignas(64) std::int32_t at[3][kLanes];
      I some(-1), whole(-1);
      for (int k = 0; k < 3; ++k) {
        const I here = of_blocks[k] + I(s.step_x[k] * x + s.step_y[k] * y);
        store(here, at[k]);
        some = some & (here + least[k]);
        whole = whole & (here + greatest[k]);
      }
      blocks &= bits_of(some < I(0));
      if (blocks == 0) continue;
      unsigned of_all = kSampleCount == 1 ? blocks & bits_of(whole < I(0)) : 0;
      ahead(x, y, group, of_all != 0);
      if constexpr (kSampleCount == 1) {
        blocks ^= of_all;
        Mask<R> covered[1][kParts<R>];
        std::ranges::fill(covered[0], Lanes<R>::mask_of(~0u));
        for (; of_all != 0; of_all &= of_all - 1) {
          const int b = std::countr_zero(of_all);
          block(x + group.x(b), y + group.y(b), b, covered, std::true_type());
        }
      }
      for (; blocks != 0; blocks &= blocks - 1) {
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
        if (any(any_covered)) block(x + group.x(b), y + group.y(b), b, covered, std::false_type());
      }
    }
  }
}

/// Iterator over a run's primitives, a group of as many as there are lanes at a time: after next() returns true,
/// `corner` and `count` are the group's. `from_last`: in reverse order.
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
      for (std::size_t k = 0; k < 3; ++k) corner[k][lane] = t.corner[k];
    }
    return true;
  }
  /// Sets up `lanes` from the group, if all are triangles; else no lane fits.
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
      set_up_lanes<R, kSampleCount>(corner, facing, painting_, painting_.draws[run_.draw], tile_, lanes);
  }
  const PaintTriangle& triangle(int lane) const {  ///< lane < count
    const std::size_t n = begin_ + static_cast<std::size_t>(lane);
    return run_.triangles[run_.numbers[from_last_ ? run_.numbers.size() - 1 - n : n]];
  }
  bool fits(int lane) const { return (lanes.fitting >> lane & 1u) != 0; }
  bool all_fit() const { return lanes.fitting == ~0u >> (32 - kLanes); }

  std::uint32_t corner[3][Lanes<R>::width];  ///< CornersOfLanes
  LaneTriangles<R, kSampleCount> lanes;
  int count = 0;  ///< number of lanes that hold a primitive

 private:
  static constexpr std::size_t kLanes = Lanes<R>::width;
  // Surplus lanes repeat the last triangle.
  const PaintTriangle& in_lane(std::size_t lane) const { return triangle(std::min(static_cast<int>(lane), count - 1)); }

  const Painting& painting_;
  const PaintRun& run_;
  bool from_last_;
  glm::ivec2 tile_;  // lower left pixel of the tile
  std::size_t begin_ = 0;
};

}  // namespace plumbline::pipeline

// Stages 7 to 11 of a triangle's fragments that are coloured by a surface and replace the stored colour. Fragments that
// passed the depth test are collected from their blocks, so that every lane shades one.
#pragma once

#include <array>
#include <bit>
#include <optional>

#include "painter/lone_triangle.h"
#include "painter/visit_covered.h"

namespace plumbline::pipeline {

/// Collector of one triangle's pixels: add() block by block, then finish(). A pixel is shaded once for all its samples.
template <class R, int kSampleCount>
class ShadedPixels {
 public:
  ShadedPixels(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle,
               const LaneSetup<kSampleCount>& setup, PackedTile* tiles)
      : painting_(painting), draw_(draw), triangle_(triangle), setup_(setup), tiles_(tiles) {}

  /// Adds the pixels `kept` of the part of a block that begins at index `place` of the tile's arrays.
  void add(int place, const std::array<Mask<R>, kSampleCount>& kept) {
    Mask<R> any_kept = kept[0];
    for (std::size_t i = 1; i < kSampleCount; ++i) any_kept = any_kept | kept[i];
    unsigned some = bits_of(any_kept);
    store_kept(any_kept, Lanes<R>::load(kBlockNumbers) + Int<R>(place), places_ + count_);
    if constexpr (kSampleCount == 1) {
      count_ += std::popcount(some);
    } else {
      unsigned of_sample[kSampleCount];
      for (std::size_t i = 0; i < kSampleCount; ++i) of_sample[i] = bits_of(kept[i]);
      for (; some != 0; some &= some - 1, ++count_) {
        for (int i = 0; i < kSampleCount; ++i) kept_[count_][i] = (of_sample[i] >> std::countr_zero(some) & 1u) != 0;
      }
    }
    if (count_ >= kLanes) shade(kLanes);
  }
  void finish() {
    if (count_ == 0) return;
    const int count = count_;
    while (count_ < kLanes) places_[count_++] = places_[0];
    shade(count);
  }

 private:
  static constexpr int kLanes = Lanes<R>::width;

  // Shades the last kLanes of the collected pixels and writes the first `count` of these.
  void shade(int count) {
    using I = Int<R>;
    const int x0 = tiles_[0].x0, y0 = tiles_[0].y0;
    if (!surface_) surface_ = surface_setup(painting_, draw_, triangle_, setup_.gradients);
    count_ -= kLanes;
    const I place = Lanes<R>::load(places_ + count_);
    const I x = I(x0) + x_of_place(place), y = I(y0) + y_of_place(place);
    const Pixels<R> p{x, y, to_wide(x) + 0.5, to_wide(y) + 0.5};
    const SurfaceAttributes<R> attributes = surface_attributes<R>(setup_, *surface_, p);
    alignas(64) std::int32_t codes[kLanes];
    store(packed_merge(pipeline::shade<R>(*surface_->surface, setup_.front, attributes)), codes);
    for (int lane = 0; lane < count; ++lane) {
      for (int i = 0; i < kSampleCount; ++i) {
        if (kSampleCount == 1 || kept_[count_ + lane][i])
          tiles_[i].color[places_[count_ + lane]] = static_cast<std::uint32_t>(codes[lane]);
      }
    }
  }

  const Painting& painting_;
  const PaintDraw& draw_;
  const PaintTriangle& triangle_;
  const LaneSetup<kSampleCount>& setup_;
  PackedTile* tiles_;
  std::optional<SurfaceSetup> surface_;  ///< set when the first pixel is shaded
  std::int32_t places_[2 * kLanes];
  bool kept_[2 * kLanes][kSampleCount];
  int count_ = 0;
};

}  // namespace plumbline::pipeline

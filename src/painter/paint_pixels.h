// Single pixels of as many triangles or lines as there are lanes: first the values of all lanes' first pixels together,
// of their second pixels, and so on; then the pixels are written to the tile, one primitive after the other.
#pragma once

#include <bit>

#include "painter/surface_lanes.h"

namespace plumbline::pipeline {

inline constexpr double kMostZ24 = 16777215;  ///< largest depth code of z24

/// mean() of a colour with the same alpha at all corners, where 1/w is not near 0.
template <class R>
[[gnu::always_inline]] inline Color<R> plain_color(const auto& s, const R& q1, const R& q2, const R& sum,
                                                   const R& alpha) {
  const R reciprocal = R(1) / sum;
  const Weights<R> k{q1 * reciprocal, q2 * reciprocal};
  return {Vec3<R>(mixed<R>(s, k)), alpha};
}

/// Source of the pixels' colours. none: no colour is written; own: the interpolated colour; given: set_codes().
enum class PixelColors { none, own, given };

/// Fragments of rgba8 and z24 that replace the stored ones where they are nearer. `kPlain`: all lanes have plain_depth
/// and plain_color (LaneTriangles). `kMost`: greatest number of pixels per lane.
template <class R, PixelColors kColors, bool kPlain, int kMost>
class PixelsOfLanes {
 public:
  /// `sample`: index of the sample whose depths are taken.
  template <int kSampleCount>
  [[gnu::always_inline]] PixelsOfLanes(const LaneTriangles<R, kSampleCount>& lanes, int sample)
      : code_(lanes.code[sample].of_all()),
        q1_(lanes.q1.of_all()),
        q2_(lanes.q2.of_all()),
        sum_(lanes.sum.of_all()),
        color_(colors_of<R>(lanes)) {}

  /// Computes each lane's i-th pixel: index in the tile, depth code and, for PixelColors::own, colour. (x, y): counted
  /// from the tile's first pixel.
  [[gnu::always_inline]] void work_out(int i, const Int<R>& x, const Int<R>& y) {
    using W = Wide<R>;
    const Offset<R> at{to_wide(x), to_wide(y)};
    const auto value = [&](const Affine<W>& f) { return value_at<R>(f, at); };
    store(place_in_tile(x, y), place_of_[i]);
    if constexpr (kPlain) {
      store(to_float(nearest_int(value(code_))), z_of_[i]);
    } else {
      store(to_float(round_even(clamped(value(code_), W(0), W(kMostZ24)))), z_of_[i]);
    }
    if constexpr (kColors == PixelColors::own) {
      const R q1 = to_float(value(q1_)), q2 = to_float(value(q2_)), sum = to_float(value(sum_));
      if constexpr (kPlain) {
        store(packed_merge_near(plain_color(color_, q1, q2, sum, color_.value0.a)), color_of_[i]);
      } else {
        store(packed_merge(mean_of_lanes<R>(color_, weights<R>(q1, q2, sum))), color_of_[i]);
      }
    }
  }

  /// Whether the i-th pixel of any of the lanes `of_lanes` (a bit each) is nearer than the stored one.
  [[gnu::always_inline]] bool any_nearer(int i, unsigned of_lanes, const PackedTile& tile) const {
    for (; of_lanes != 0; of_lanes &= of_lanes - 1) {
      const int lane = std::countr_zero(of_lanes);
      if (z_of_[i][lane] < tile.depth[place_of_[i][lane]]) return true;
    }
    return false;
  }
  [[gnu::always_inline]] void set_codes(int i, const Int<R>& codes) { store(codes, color_of_[i]); }

  /// Writes a lane's first `count` pixels where they pass the depth test. `from_last`: triangles come from the last to
  /// the first, so a fragment replaces a stored fragment of equal depth, but never passes at the clear depth.
  [[gnu::always_inline]] void paint(int lane, int count, bool from_last, float cleared, PackedTile& tile) const {
    for (int i = 0; i < count; ++i) {
      const int place = place_of_[i][lane];
      const float z = z_of_[i][lane], held = tile.depth[place];
      if (from_last ? z <= held && z < cleared : z < held) {
        tile.depth[place] = z;
        if constexpr (kColors != PixelColors::none) tile.color[place] = static_cast<std::uint32_t>(color_of_[i][lane]);
      }
    }
  }

 private:
  static constexpr int kLanes = Lanes<R>::width;
  Affine<Wide<R>> code_, q1_, q2_, sum_;
  AttributeLanes<R> color_;
  alignas(64) float z_of_[kMost][kLanes];
  alignas(64) std::int32_t color_of_[kMost][kLanes], place_of_[kMost][kLanes];
};

}  // namespace plumbline::pipeline

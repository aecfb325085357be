// A tile: a square of the frame, stored block by block while it is painted.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernels/attributes.h"
#include "kernels/lanes.h"
#include "kernels/merge.h"
#include "pipeline/frame.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// Addresses of consecutive pixels' values in a Tile: depth and colour in the frame's formats, as floats.
struct Stored {
  float* depth;
  float* color[4];
  std::uint8_t* stencil;

  template <class R>
  Color<R> load_color() const {
    return {Lanes<R>::load(color[0]), Lanes<R>::load(color[1]), Lanes<R>::load(color[2]), Lanes<R>::load(color[3])};
  }
  template <class R>
  void store_color(Mask<R> kept, const Color<R>& merged, const glm::bvec4& channels) const {
    for (int c = 0; c < 4; ++c) {
      if (channels[c]) store(kept, merged[c], color[c]);
    }
  }
};
/// Addresses of consecutive pixels' values in a PackedTile; colours are rgba8, red in the lowest byte.
struct StoredCodes {
  float* depth;
  std::uint32_t* color;
  std::uint8_t* stencil;

  template <class R>
  Color<R> load_color() const {
    const Int<R> held = Lanes<R>::load(color), most(255);
    return {to_float(held & most), to_float(shifted_right<8>(held) & most), to_float(shifted_right<16>(held) & most),
            to_float(shifted_right<24>(held) & most)};
  }
  /// merge() and store_color() at once.
  template <class M, class R>
  void store_merged(M kept, const Color<R>& shaded) const {
    store_packed(kept, packed_merge(shaded), color);
  }
  template <class R>
  void store_color(Mask<R> kept, const Color<R>& merged, const glm::bvec4& channels) const {
    if (!glm::any(channels)) return;
    const Int<R> codes = packed_codes(merged.r, merged.g, merged.b, merged.a);
    if (glm::all(channels)) return store_packed(kept, codes, color);
    const std::uint32_t written = (channels.r ? 0xffu : 0u) | (channels.g ? 0xff00u : 0u) |
                                  (channels.b ? 0xff0000u : 0u) | (channels.a ? 0xff000000u : 0u);
    const Int<R> to(static_cast<std::int32_t>(written)), other(static_cast<std::int32_t>(~written));
    store_packed(kept, (codes & to) | (Lanes<R>::load(color) & other), color);
  }
};

/// Index, in a tile's arrays, of the first pixel of the block of (x, y), counted from the tile.
inline int block_offset(int x, int y) {
  static_assert(kBlock == 4 && kTile == 64);
  return (y >> 2 << 8) + (x >> 2 << 4);
}
/// Index, in a tile's arrays, of pixel (x, y), counted from the tile.
inline int pixel_offset(int x, int y) { return block_offset(x, y) + y % kBlock * kBlock + x % kBlock; }

/// A square of the frame, stored block by block; colour and depth in the frame's formats, as floats.
struct Tile {
  int x0, y0;  ///< its lower left pixel
  alignas(64) float depth[kTile * kTile];
  alignas(64) float color[4][kTile * kTile];
  alignas(64) std::uint8_t stencil[kTile * kTile];  ///< not used where the frame has none

  Stored at(int place) {
    return {depth + place, {color[0] + place, color[1] + place, color[2] + place, color[3] + place}, stencil + place};
  }
};
/// Tile of rgba8 frames: half the memory, colours as the frame stores them.
struct PackedTile {
  int x0, y0;  ///< its lower left pixel
  alignas(64) float depth[kTile * kTile];
  alignas(64) char apart[2112];  ///< padding: a pixel's depth and colour 16 KiB apart would stall loads
  alignas(64) std::uint32_t color[kTile * kTile];
  alignas(64) std::uint8_t stencil[kTile * kTile];
  alignas(64) float farthest[kTile * kTile / kBlockPixels];  ///< per block: an upper bound of its depths
  float farthest_of_all;                                     ///< an upper bound of all depths

  StoredCodes at(int place) { return {depth + place, color + place, stencil + place}; }
};

/// Copies the tile's part inside the frame into those planes that the frame has.
void write_out(Tile& tile, Frame& frame);
void write_out(PackedTile& tile, Frame& frame);

}  // namespace plumbline::pipeline

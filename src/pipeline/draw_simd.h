// Stages 5 to 11 by SIMD, with dispatch at run time. The float instantiation (fragment.h) is the definition: every
// target makes the same bits.
#pragma once

#include <span>
#include <string_view>

#include "pipeline/tiles.h"

namespace plumbline::pipeline {

/// A tile's triangles over what the tile holds (draw_tile(), tiles.h), by the stage functions of this folder.
using DrawTile = void (*)(const TileList& work, std::size_t number_of_tile, Tile& tile);

struct SimdTarget {
  std::string_view name;  ///< "float" (one pixel at a time), "sse4", "avx2"
  DrawTile draw_tile;
};
/// Those that this machine has, the widest last.
std::span<const SimdTarget> simd_targets();

void draw_frame(DrawTile draw_tile, const DrawList& list, const FrameFormat& format, Frame& frame);

}  // namespace plumbline::pipeline

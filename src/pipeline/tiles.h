// The order of the work: the frame tile by tile, in each tile its triangles in draw order, in each triangle its blocks;
// in each line and point its pixels.
#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "pipeline/fragment.h"
#include "pipeline/frame.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// The window triangles of a scene, and which draw each belongs to (draw.h, Geometry).
struct DrawList {
  std::span<const WindowTriangle<float>> triangles;
  std::span<const std::uint32_t> first_triangle;
  std::span<const Draw> draws;
  std::span<const Surface> surfaces = {};  ///< per draw; empty: all are plain
  bool depth_clamp = false;
};

/// For each tile, row by row from the bottom, the numbers of the triangles whose bounding box touches it, ascending.
struct Bins {
  int columns = 0, rows = 0;
  std::vector<std::size_t> first;  ///< tile t has [first[t], first[t + 1]) of numbers
  std::vector<std::uint32_t> numbers;
};
Bins bin(std::span<const WindowTriangle<float>> triangles, const FrameFormat& frame);

Formats formats_of(const FrameFormat& frame);
/// What a cleared pixel holds, in the frame's formats.
struct ClearPixel {
  float depth;
  Color<float> color;
};
ClearPixel clear_pixel(const FrameFormat& frame, const Formats& formats);
void clear(Tile& tile, const FrameFormat& frame, const Formats& formats);
/// Copies the tile's part of the frame out of its blocks.
void write_out(const Tile& tile, Frame& frame);
void write_out(const PackedTile& tile, Frame& frame);

/// `varying`: each of a surface's varyings at the triangle's corners.
template <class R, class Stages, class Tap>
void draw_triangle(const Stages& stages, const BlockState& state, const WindowTriangle<float>& triangle,
                   std::uint32_t number, const auto& varying, const Formats& formats, auto& tile, Tap& tap) {
  SetupOf<Stages> s = set_up(stages, triangle, number, state.depth, formats.sample, tile.x0, tile.y0);
  SurfaceSetup surface;
  if constexpr (Stages::has_surfaces) {
    if (state.surface != nullptr) {
      surface = set_up_surface(stages, *state.surface, triangle, number, varying, s.planes);
      s.surface = &surface;
    }
  }
  if (triangle.corners < 3) {
    return thin_fragments<R>(stages, state, triangle, s, formats.color_scale, tile, tap);
  }
  const int x0 = std::max(s.bounds.x0, tile.x0) & ~(kBlock - 1), x1 = std::min(s.bounds.x1, tile.x0 + kTile);
  const int y0 = std::max(s.bounds.y0, tile.y0) & ~(kBlock - 1), y1 = std::min(s.bounds.y1, tile.y0 + kTile);
  for (int y = y0; y < y1; y += kBlock) {
    for (int x = x0; x < x1; x += kBlock) {
      for (int i = 0; i < kBlockPixels; i += Lanes<R>::width) {
        const Pixels<R> p = block_pixels<R>(x, y, i);
        const Mask<R> covered = stages.template coverage<R>(s, p);
        const int place = tile.offset(x, y) + i;
        if (any(covered)) covered_pixels<R>(stages, state, s, p, covered, place, formats.color_scale, tile, tap);
      }
    }
  }
}

/// All that the tiles of a frame are drawn from.
struct TileList {
  const DrawList& list;
  const FrameFormat& format;
  Formats formats;
  Bins bins;
  std::vector<BlockState> state_of;  ///< per draw
};
/// `surface`: null where the draw is plain.
BlockState block_state(const Draw& draw, DepthFormat format, bool depth_clamp, const Surface* surface);
TileList tile_list(const DrawList& list, const FrameFormat& format);

/// What lies in the tile, over what it holds.
template <class R, class Stages, class Tap>
void draw_tile(const Stages& stages, const TileList& work, std::size_t number_of_tile, Tile& tile, Tap& tap) {
  const DrawList& list = work.list;
  std::size_t draw = 0;
  for (std::size_t i = work.bins.first[number_of_tile]; i < work.bins.first[number_of_tile + 1]; ++i) {
    const std::uint32_t number = work.bins.numbers[i];
    while (number >= list.first_triangle[draw + 1]) ++draw;
    const auto varying = [&](Varying v) -> const std::array<Vec4<float>, 3>& {
      return work.state_of[draw].surface->columns[static_cast<std::size_t>(v)][number];
    };
    draw_triangle<R>(stages, work.state_of[draw], list.triangles[number], number, varying, work.formats, tile, tap);
  }
}

/// The frame, tile by tile: `draw(number of the tile, tile)` draws into one that is clear.
void each_tile(const TileList& work, Frame& frame, const std::function<void(std::size_t, Tile&)>& draw);

template <class R, class Stages, class Tap>
void draw_tiles(const Stages& stages, const DrawList& list, const FrameFormat& format, Frame& frame, Tap& tap) {
  TileList work = tile_list(list, format);
  for (BlockState& state : work.state_of) state.merge = stages.merge_state(state.merge);
  each_tile(work, frame, [&](std::size_t number, Tile& tile) { draw_tile<R>(stages, work, number, tile, tap); });
}

}  // namespace plumbline::pipeline

// The order of the work: the frame tile by tile, in each tile its triangles in draw order, in each triangle its blocks;
// in each line and point its pixels.
#pragma once

#include <algorithm>
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
void clear(Tile& tile, const FrameFormat& frame, const Formats& formats);
/// Copies the tile's part of the frame out of its blocks.
void write_out(const Tile& tile, Frame& frame);

template <class R, DepthFunc func, class Stages, class Tap>
void draw_triangle(const Stages& stages, const BlockState& state, const WindowTriangle<float>& triangle,
                   std::uint32_t number, const Formats& formats, Tile& tile, Tap& tap) {
  SetupOf<Stages> s = set_up(stages, triangle, number, state.depth, formats.sample, tile.x0, tile.y0);
  SurfaceSetup surface;
  if constexpr (Stages::has_surfaces) {
    if (state.surface != nullptr) {
      surface = set_up_surface(stages, *state.surface, triangle, number, s.planes);
      s.surface = &surface;
    }
  }
  if (triangle.corners < 3) {
    for (const glm::ivec2 pixel : stages.thin_pixels(triangle, {tile.x0, tile.y0}, kTile)) {
      fragment_pixel<R, func>(stages, state, s, pixel, formats.color_scale, tile, tap);
    }
    return;
  }
  const int x0 = std::max(s.bounds.x0, tile.x0) & ~(kBlock - 1), x1 = std::min(s.bounds.x1, tile.x0 + kTile);
  const int y0 = std::max(s.bounds.y0, tile.y0) & ~(kBlock - 1), y1 = std::min(s.bounds.y1, tile.y0 + kTile);
  for (int y = y0; y < y1; y += kBlock) {
    for (int x = x0; x < x1; x += kBlock) {
      fragment_block<R, func>(stages, state, s, x, y, formats.color_scale, tile, tap);
    }
  }
}

template <class R, class Stages, class Tap>
using DrawTriangle = void (*)(const Stages&, const BlockState&, const WindowTriangle<float>&, std::uint32_t,
                              const Formats&, Tile&, Tap&);

/// The instantiation for a depth function, chosen once per draw.
template <class R, class Stages, class Tap>
DrawTriangle<R, Stages, Tap> draw_triangle_for(DepthFunc func) {
  switch (func) {
    case DepthFunc::never: return draw_triangle<R, DepthFunc::never, Stages, Tap>;
    case DepthFunc::less: return draw_triangle<R, DepthFunc::less, Stages, Tap>;
    case DepthFunc::equal: return draw_triangle<R, DepthFunc::equal, Stages, Tap>;
    case DepthFunc::less_equal: return draw_triangle<R, DepthFunc::less_equal, Stages, Tap>;
    case DepthFunc::greater: return draw_triangle<R, DepthFunc::greater, Stages, Tap>;
    case DepthFunc::not_equal: return draw_triangle<R, DepthFunc::not_equal, Stages, Tap>;
    case DepthFunc::greater_equal: return draw_triangle<R, DepthFunc::greater_equal, Stages, Tap>;
    case DepthFunc::always: return draw_triangle<R, DepthFunc::always, Stages, Tap>;
  }
  return nullptr;
}

template <class R, class Stages, class Tap>
void draw_tiles(const Stages& stages, const DrawList& list, const FrameFormat& format, Frame& frame, Tap& tap) {
  const Bins bins = bin(list.triangles, format);
  const Formats formats = formats_of(format);
  std::vector<DrawTriangle<R, Stages, Tap>> draw_of;
  std::vector<BlockState> state_of;
  for (std::size_t d = 0; d < list.draws.size(); ++d) {
    const Draw& draw = list.draws[d];
    const bool plain = list.surfaces.empty() || list.surfaces[d].plain();
    draw_of.push_back(draw_triangle_for<R, Stages, Tap>(draw.depth_func));
    state_of.push_back({depth_state(draw, format.depth, list.depth_clamp), draw.scissor, draw.alpha_test, draw.stencil,
                        stages.merge_state(draw.merge), plain ? nullptr : &list.surfaces[d]});
  }
  Tile tile{};
  for (int t = 0; t < bins.columns * bins.rows; ++t) {
    tile.x0 = t % bins.columns * kTile;
    tile.y0 = t / bins.columns * kTile;
    clear(tile, format, formats);
    std::size_t draw = 0;
    for (std::size_t i = bins.first[static_cast<std::size_t>(t)]; i < bins.first[static_cast<std::size_t>(t) + 1];
         ++i) {
      const std::uint32_t number = bins.numbers[i];
      while (number >= list.first_triangle[draw + 1]) ++draw;
      draw_of[draw](stages, state_of[draw], list.triangles[number], number, formats, tile, tap);
    }
    write_out(tile, frame);
  }
}

}  // namespace plumbline::pipeline

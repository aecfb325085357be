// Stages 5 to 11 of a tile, as the painter does them: triangles set up in lanes, blocks in rows.
#pragma once

#include <algorithm>
#include <bit>

#include "pipeline/set_up_lanes.h"

namespace plumbline::pipeline {

alignas(64) inline constexpr std::int32_t kBlockNumbers[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

/// The pixels that three edges cover: visit(x, y and number of the block's first of them, which of them), block by
/// block. x, y: of the tile.
template <class R>
void visit_covered(const auto& s, auto visit) {
  using I = Int<R>;
  constexpr int kLanes = Lanes<R>::width, kParts = kBlockPixels / kLanes;
  I in_block[3][kParts];  // what E adds to that of the block's first pixel
  alignas(64) static constexpr std::int32_t kX[] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
  alignas(64) static constexpr std::int32_t kY[] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
  for (int k = 0; k < 3; ++k) {
    for (int part = 0; part < kParts; ++part) {
      in_block[k][part] = load_ints<R>(kX + part * kLanes) * I(s.edge[k].step_x) +
                          load_ints<R>(kY + part * kLanes) * I(s.edge[k].step_y);
    }
  }
  const auto block = [&](int x, int y) {
    const std::int32_t at[3] = {s.edge[0].at_tile + s.edge[0].step_x * x + s.edge[0].step_y * y,
                                s.edge[1].at_tile + s.edge[1].step_x * x + s.edge[1].step_y * y,
                                s.edge[2].at_tile + s.edge[2].step_x * x + s.edge[2].step_y * y};
#pragma GCC unroll 1
    for (int part = 0; part < kParts; ++part) {
      const Mask<R> covered =
          ((I(at[0]) + in_block[0][part]) | (I(at[1]) + in_block[1][part]) | (I(at[2]) + in_block[2][part])) >= I(0);
      if (any(covered)) visit(x, y, part * kLanes, covered);
    }
  };
  // A row of blocks at once: those where an edge is negative even at its most are empty. Few are looked at one by one.
  const bool few = s.x1 - s.x0 <= 3 * kBlock;
  I most[3];
  for (int k = 0; k < 3; ++k) {
    const TileEdge& e = s.edge[k];
    most[k] = load_ints<R>(kBlockNumbers) * I(kBlock * e.step_x) +
              I(e.at_tile + (kBlock - 1) * ((e.step_x > 0 ? e.step_x : 0) + (e.step_y > 0 ? e.step_y : 0)));
  }
  for (int y = s.y0; y < s.y1; y += kBlock) {
    for (int x = s.x0; x < s.x1; x += kBlock * kLanes) {
      const int left = (s.x1 - x + kBlock - 1) / kBlock;
      unsigned blocks = left < kLanes ? (1u << left) - 1 : ~0u >> (32 - kLanes);
      if (!few) {
        const auto at = [&](int k) { return most[k] + I(s.edge[k].step_x * x + s.edge[k].step_y * y); };
        blocks &= bits_of((at(0) | at(1) | at(2)) >= I(0));
      }
      for (; blocks != 0; blocks &= blocks - 1) block(x + kBlock * std::countr_zero(blocks), y);
    }
  }
}

/// A triangle's varyings at its corners; of those that light made, flat shading takes the provoking one's.
inline std::array<Vec4<float>, 3> varying_of(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t,
                                             Varying v) {
  const Vec4<float>* column = painting.varyings[static_cast<std::size_t>(v)];
  const bool flat = draw.flat && is_lit(v);
  return {column[t.corner[flat ? 1 : 0]], column[t.corner[1]], column[t.corner[flat ? 1 : 2]]};
}

/// The triangle as stage 4 has it.
inline WindowTriangle<float> record_of(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t) {
  WindowTriangle<float> record{{}, 0, t.front, t.corners, t.width};
  for (std::size_t k = 0; k < 3; ++k) record.v[k] = painting.vertices[t.corner[k]];
  if (draw.flat) record.v[0].color = record.v[2].color = record.v[1].color;
  return record;
}

/// Of lines, points, and triangles whose edges do not fit: one by one (tiles.h).
template <class R>
void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, auto& tile) {
  NoTap tap;
  const auto varying = [&](Varying v) { return varying_of(painting, draw, triangle, v); };
  draw_triangle<R>(FragmentStages(), draw.state, record_of(painting, draw, triangle), 0, varying, painting.formats,
                   tile, tap);
}

/// What is left to do for a lane.
inline void finish_lane(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t,
                        LaneSetup<DepthSetup>& s) {
  s.depth.scale = painting.formats.depth_scale;
  s.depth.low = draw.state.depth.low;
  s.depth.high = draw.state.depth.high;
  if (draw.state.depth.offset == PolygonOffset{}) return;
  s.depth = depth_setup(record_of(painting, draw, t), draw.state.depth);
  if (painting.formats.sample != glm::ivec2(0)) s.depth = moved(s.depth, s.planes, painting.formats.sample);
}

/// A draw's triangles in the tile.
template <class R>
void paint_in_lanes(const Painting& painting, const PaintDraw& draw, const Chunk& chunk,
                    std::span<const std::uint32_t> numbers, const auto& state, auto& tile) {
  constexpr std::size_t kLanes = Lanes<R>::width;
  const PaintTriangle* triangles = chunk.triangles.data();
  const SetupSite site{tile.x0, tile.y0, painting.formats.sample, draw.flat};
  constexpr bool packed = std::is_same_v<std::decay_t<decltype(tile)>, PackedTile>;
  const float color_scale = packed ? 255.0f : painting.formats.color_scale;
  NoTap tap;
  SetupLanes<R> lanes;
  for (std::size_t i = 0; i < numbers.size(); i += kLanes) {
    const std::size_t count = std::min(kLanes, numbers.size() - i);
    const WindowVertex<float>* corner[3][kLanes];
    alignas(64) float facing[kLanes];
    unsigned thin = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {  // lanes that are too many do as the last
      const PaintTriangle& t = triangles[numbers[i + std::min(lane, count - 1)]];
      for (std::size_t k = 0; k < 3; ++k) corner[k][lane] = painting.vertices + t.corner[k];
      facing[lane] = t.front ? 1.0f : -1.0f;
      thin |= t.corners < 3 ? 1u << lane : 0u;
    }
    lanes.fitting = 0;
    if (thin == 0) set_up_lanes<R>(corner, facing, site, lanes);
    for (std::size_t lane = 0; lane < count; ++lane) {
      const PaintTriangle& t = triangles[numbers[i + lane]];
      if ((lanes.fitting >> lane & 1u) == 0) {
        paint_alone<R>(painting, draw, t, tile);
        continue;
      }
      constexpr bool replaces = std::is_same_v<std::decay_t<decltype(state)>, ReplacingState>;
      auto s = lanes.template of<std::conditional_t<replaces, Z24Setup, DepthSetup>>(static_cast<int>(lane));
      s.front = t.front;
      s.planes.x0 = tile.x0 + 0.5;
      s.planes.y0 = tile.y0 + 0.5;
      if constexpr (!replaces) finish_lane(painting, draw, t, s);
      const auto visit = [&](const auto& setup) {
        visit_covered<R>(setup, [&](int x, int y, int part, Mask<R> covered) {
          covered_pixels<R>(FragmentStages(), state, setup, block_pixels<R>(tile.x0 + x, tile.y0 + y, part), covered,
                            block_offset(x, y) + part, color_scale, tile, tap);
        });
      };
      if constexpr (replaces) {
        visit(s);
      } else if (draw.state.surface == nullptr) {
        visit(s);
      } else {
        const auto varying = [&](Varying v) { return varying_of(painting, draw, t, v); };
        const SurfaceSetup surface =
            set_up_surface(FragmentStages(), *draw.state.surface, record_of(painting, draw, t), 0, varying, s.planes);
        visit(LaneSurfaceSetup{s, &surface});
      }
    }
  }
}

template <class R>
void paint_replacing(const Painting& painting, const PaintDraw& draw, const Chunk& chunk,
                     std::span<const std::uint32_t> numbers, PackedTile& tile) {
  paint_in_lanes<R>(painting, draw, chunk, numbers, ReplacingState(), tile);
}

/// All of a chunk's triangles in the tile, draw by draw.
template <class R>
void paint_chunk(const Painting& painting, const Chunk& chunk, std::span<const std::uint32_t> numbers, auto& tile) {
  auto of_draw = chunk.draws.begin();
  while (!numbers.empty()) {
    while (numbers.front() >= of_draw->end) ++of_draw;
    const auto end =
        std::partition_point(numbers.begin(), numbers.end(), [&](std::uint32_t n) { return n < of_draw->end; });
    const std::span<const std::uint32_t> run(numbers.begin(), end);
    const PaintDraw& draw = painting.draws[of_draw->draw];
    bool painted = false;
    if constexpr (std::is_same_v<std::decay_t<decltype(tile)>, PackedTile>) {
      if (draw.replaces) paint_replacing<R>(painting, draw, chunk, run, tile), painted = true;
    }
    if (!painted) paint_in_lanes<R>(painting, draw, chunk, run, draw.state, tile);
    numbers = numbers.subspan(run.size());
  }
}

/// Copies the tile's part of the frame out of its blocks, four pixels of a row at once.
template <class R>
void stream_out(const PackedTile& tile, Frame& frame) {
  const int width = frame.color_rgba8.width(), height = frame.color_rgba8.height();
  if (width % kBlock != 0 || frame.depth_code.empty() || !frame.stencil.empty()) return write_out(tile, frame);
  auto* colors = reinterpret_cast<std::uint32_t*>(frame.color_rgba8.values().data());
  std::uint32_t* depths = frame.depth_code.values().data();
  const int blocks = std::min(kTile, width - tile.x0) / kBlock;
  for (int y = 0; y < std::min(kTile, height - tile.y0); ++y) {
    const std::size_t to =
        static_cast<std::size_t>(tile.y0 + y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(tile.x0);
    const int from = block_offset(0, y) + y % kBlock * kBlock;
    for (int b = 0; b < blocks; ++b) stream_codes<R>(tile.color + from + b * kBlockPixels, colors + to + b * kBlock);
    for (int b = 0; b < blocks; ++b) stream_whole<R>(tile.depth + from + b * kBlockPixels, depths + to + b * kBlock);
  }
}
template <class R>
void stream_out(const Tile& tile, Frame& frame) {
  write_out(tile, frame);
}

/// The tile, from clear to the frame.
template <class R>
void paint_tile_in(const Painting& painting, int number, auto& tile, Frame& frame) {
  tile.x0 = number % painting.columns * kTile;
  tile.y0 = number / painting.columns * kTile;
  clear(tile, painting.format, painting.formats);
  for (const Chunk& chunk : painting.chunks) {
    const auto t = static_cast<std::size_t>(number);
    const std::uint32_t begin = chunk.first[t], end = chunk.first[t + 1];
    paint_chunk<R>(painting, chunk, std::span(chunk.numbers.data() + begin, end - begin), tile);
  }
  stream_out<R>(tile, frame);
}
template <class R>
void paint_tile(const Painting& painting, int number, TileMemory& memory, Frame& frame) {
  if (painting.format.color == ColorFormat::rgba8) return paint_tile_in<R>(painting, number, memory.packed, frame);
  paint_tile_in<R>(painting, number, memory.tile, frame);
}

}  // namespace plumbline::pipeline

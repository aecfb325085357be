// Stages 5 to 12 of a tile: its runs of triangles, each by its draw's kernel (paint_opaque.h, paint_lines.h) or by
// paint_run(), which serves any state; then the tile is written to the frame.
#pragma once

#include <algorithm>
#include <span>

#include "kernels/merge.h"
#include "painter/paint_lines.h"
#include "painter/paint_opaque.h"

namespace plumbline::pipeline {

/// Depth plane of a lane's triangle, with the draw's clamp range and polygon offset. `code`: without the offset.
inline DepthPlane depth_of_lane(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t,
                                const Affine<double>& code, int x0, int y0) {
  const double scale = painting.formats.depth_scale, unit = scale == 0 ? 1 : scale;
  if (draw.depth.offset == PolygonOffset{}) {
    return {code, scale, draw.depth.low * unit, draw.depth.high * unit};
  }
  const WindowTriangle record = window_triangle_of(painting, t);
  return at_offset(depth_plane(depth_setup(record, draw.depth), planes_of(record, x0, y0)), painting.formats.sample);
}

/// Paints the triangles, lines and points of the run, under any state.
template <class R>
void paint_run(const Painting& painting, const PaintRun& run, auto& tile) {
  const PaintDraw& draw = painting.draws[run.draw];
  LanesOfRun<R, 1> lanes(painting, run, false, tile.x0, tile.y0);
  const auto paint_lane = [&](const PaintTriangle& t, int lane) {
    LaneSetup<> s = lanes.lanes.of(lane, t.front, tile.x0, tile.y0);
    s.depth_plane = depth_of_lane(painting, draw, t, s.depth_plane.code, tile.x0, tile.y0);
    const std::optional<SurfaceSetup> surface = surface_setup(painting, draw, t, s.gradients);
    const auto all_blocks = [](int) { return ~0u; };
    const auto none_ahead = [](int, int, const auto&, bool) {};
    visit_covered<R, 1>(s, all_blocks, none_ahead, [&](int x, int y, int, const auto& covered, auto) {
      for (int part = 0; part < kParts<R>; ++part) {
        if (!any(covered[0][part])) continue;
        const int i = part * Lanes<R>::width;
        paint_fragments<R>(*draw.draw, s, surface, block_pixels<R>(tile.x0 + x, tile.y0 + y, i), covered[0][part],
                           block_offset(x, y) + i, painting.formats.color_scale, tile);
      }
    });
  };
  while (lanes.next()) {
    lanes.set_up();
    for (int lane = 0; lane < lanes.count; ++lane) {
      const PaintTriangle& t = lanes.triangle(lane);
      lanes.fits(lane) ? paint_lane(t, lane) : paint_alone(painting, draw, t, tile);
    }
  }
}

/// Whether triangles of both draws may be in one run: kernel and shading are the same, and the kernel depends on no
/// other state.
inline bool can_share_run(const PaintDraw& a, const PaintDraw& b) {
  return a.kernel == b.kernel && a.flat() == b.flat() && a.kernel != PaintKernel::any &&
         a.kernel != PaintKernel::shades;
}

/// Runs of the tile's triangles, in draw order: per chunk, one run for each draw, or for consecutive draws that
/// can_share_run().
inline void find_runs(const Painting& painting, std::size_t tile, std::vector<PaintRun>& runs) {
  runs.clear();
  for (const Chunk& chunk : painting.chunks) {
    std::span<const std::uint32_t> numbers(chunk.numbers.data() + chunk.first[tile],
                                           chunk.first[tile + 1] - chunk.first[tile]);
    auto of_draw = chunk.draws.begin();
    while (!numbers.empty()) {
      while (numbers.front() >= of_draw->end) ++of_draw;
      const std::uint32_t draw = of_draw->draw;
      while (of_draw + 1 != chunk.draws.end() && can_share_run(painting.draws[draw], painting.draws[of_draw[1].draw]))
        ++of_draw;
      const auto end = std::ranges::lower_bound(numbers, of_draw->end);
      const auto count = static_cast<std::size_t>(end - numbers.begin());
      runs.push_back({draw, chunk.triangles.data(), numbers.first(count)});
      numbers = numbers.subspan(count);
    }
  }
}

/// Paints the tile's first runs of PaintKernel::replaces from the last triangle to the first, where the last triangle's
/// first corner is nearer than the first triangle's: then this order is likely front to back. Returns the number of
/// runs painted; 0, too, where the frame has a long edge, for paint_alone() knows no reversed order.
template <class R>
std::size_t paint_first_runs(const Painting& painting, std::span<const PaintRun> runs, PackedTile& tile) {
  const auto opaque = [&](const PaintRun& run) { return painting.draws[run.draw].kernel == PaintKernel::replaces; };
  const auto count = static_cast<std::size_t>(std::find_if_not(runs.begin(), runs.end(), opaque) - runs.begin());
  if (count == 0) return 0;
  const auto depth = [&](const PaintRun& run, std::uint32_t number) {
    return painting.vertices[run.triangles[number].corner[0]].p_win.z;
  };
  const PaintRun &first = runs[0], &last = runs[count - 1];
  if (painting.any_long_edge || !(depth(last, last.numbers.back()) < depth(first, first.numbers.front()))) return 0;
  for (std::size_t i = count; i-- > 0;) OpaqueRun<R, PaintKernel::replaces, 1>(painting, runs[i], &tile, true).paint();
  return count;
}

/// Whether the kernels of the commonest draws are compiled for R. Processors without AVX2 have paint_run() alone, which
/// draws the same bits. With kernels for SSE4, models were drawn 1.25 to 1.5 times as fast, and the renderer took a
/// fifth longer to build.
template <class R>
inline constexpr bool kHasKernels = Lanes<R>::width > 4;

/// Paints the run by its draw's kernel, which is not PaintKernel::any.
template <class R, int kSampleCount>
void paint_by_kernel(const Painting& painting, const PaintRun& run, PackedTile* tiles) {
  const PaintDraw& draw = painting.draws[run.draw];
  const auto paint_opaque = [&]<PaintKernel kKernel>() {
    OpaqueRun<R, kKernel, kSampleCount>(painting, run, tiles, false).paint();
  };
  switch (draw.kernel) {
    case PaintKernel::replaces: paint_opaque.template operator()<PaintKernel::replaces>(); break;
    case PaintKernel::blends_over: paint_opaque.template operator()<PaintKernel::blends_over>(); break;
    case PaintKernel::depth_only:
      each_sample<kSampleCount>(painting, tiles, [&](const Painting& of, PackedTile& tile) {
        OpaqueRun<R, PaintKernel::depth_only, 1>(of, run, &tile, false).paint();
      });
      break;
    case PaintKernel::shades: paint_opaque.template operator()<PaintKernel::shades>(); break;
    case PaintKernel::lines:
      each_sample<kSampleCount>(painting, tiles,
                                [&](const Painting& of, PackedTile& tile) { paint_lines<R>(of, run, tile); });
      break;
    case PaintKernel::any: break;
  }
}

/// Paints the run by its draw's kernel, or by paint_run(). `tiles`: one for each sample.
template <class R, int kSampleCount>
void paint_next_run(const Painting& painting, const PaintRun& run, PackedTile* tiles) {
  const PaintDraw& draw = painting.draws[run.draw];
  if constexpr (kHasKernels<R>) {
    if (draw.kernel != PaintKernel::any) return paint_by_kernel<R, kSampleCount>(painting, run, tiles);
  }
  const DepthFunc func = draw.draw->depth_func;
  const bool farther =
      func != DepthFunc::never && func != DepthFunc::less && func != DepthFunc::less_equal && func != DepthFunc::equal;
  each_sample<kSampleCount>(painting, tiles, [&](const Painting& of, PackedTile& tile) {
    if (farther) {
      tile.farthest_of_all = std::numeric_limits<float>::infinity();
      std::fill(std::begin(tile.farthest), std::end(tile.farthest), tile.farthest_of_all);
    }
    paint_run<R>(of, run, tile);
  });
}

/// Whether rows of the tile at column x0 are whole vectors, and the frame has codes of colour and depth and no stencil.
template <class R>
bool has_whole_lanes(const Frame& frame, int x0) {
  constexpr int kLanes = Lanes<R>::width;
  const int columns = std::min(kTile, frame.color_rgba8.width() - x0);
  return kLanes >= kBlock && columns % kLanes == 0 && !frame.depth_code.empty() && frame.stencil.empty();
}

/// Writes rows [from, to) of the tile to its part of a plane of 32-bit pixels. values_at(x, y): the row's next vector
/// from (x, y) of the tile on. Where every row is aligned to a vector, stores bypass the caches, which are smaller than
/// a frame.
template <class R>
void write_rows(auto& plane, int x0, int y0, int from, int to, auto values_at) {
  constexpr int kLanes = Lanes<R>::width;
  const int columns = std::min(kTile, plane.width() - x0), end = std::min(to, plane.height() - y0);
  const auto write = [&](auto put) {
    for (int y = from; y < end; ++y) {
      auto* row = reinterpret_cast<std::int32_t*>(plane.row(y0 + y) + x0);
      for (int x = 0; x < columns; x += kLanes) put(values_at(x, y), row + x);
    }
  };
  const auto first = reinterpret_cast<std::uintptr_t>(plane.row(y0) + x0);
  if (first % (4 * kLanes) == 0 && plane.width() % kLanes == 0) {
    write([](const Int<R>& values, std::int32_t* pixels) { stream(values, pixels); });
  } else {
    write([](const Int<R>& values, std::int32_t* pixels) { store(values, pixels); });
  }
}

/// Writes a tile without triangles to the frame. Returns false, and writes nothing, unless has_whole_lanes().
template <class R>
bool clear_out(const Painting& painting, int x0, int y0, Frame& frame) {
  if (!has_whole_lanes<R>(frame, x0)) return false;
  const auto [z, c] = clear_pixel(painting.format);
  const Int<R> color = packed_codes(R(c.r), R(c.g), R(c.b), R(c.a)), depth = to_int(R(z));
  write_rows<R>(frame.color_rgba8, x0, y0, 0, kTile, [&](int, int) { return color; });
  write_rows<R>(frame.depth_code, x0, y0, 0, kTile, [&](int, int) { return depth; });
  return true;
}

/// Fill entries [from, to) of the tile's arrays: with the clear depth, with the clear colour.
template <class R>
void clear_depths(auto& tile, const ClearPixel& clear, int from, int to) {
  for (int i = from; i < to; i += Lanes<R>::width) store(R(clear.depth), tile.depth + i);
}
template <class R>
void clear_colors(Tile& tile, const ClearPixel& clear, int from, int to) {
  for (int c = 0; c < 4; ++c) {
    for (int i = from; i < to; i += Lanes<R>::width) store(R(clear.color[c]), tile.color[c] + i);
  }
}
template <class R>
void clear_colors(PackedTile& tile, const ClearPixel& clear, int from, int to) {
  const Color<R> color(clear.color);
  const Int<R> codes = packed_codes(color.r, color.g, color.b, color.a);
  for (int i = from; i < to; i += Lanes<R>::width) store(codes, reinterpret_cast<std::int32_t*>(tile.color + i));
}
inline void clear_bounds(PackedTile& tile, const ClearPixel& clear) {
  std::fill(std::begin(tile.farthest), std::end(tile.farthest), clear.depth);
  tile.farthest_of_all = clear.depth;
}
inline void clear_bounds(Tile&, const ClearPixel&) {}

/// Fills the tile with the frame's clear values.
template <class R>
void clear(auto& tile, const FrameFormat& format) {
  const ClearPixel cleared = clear_pixel(format);
  clear_depths<R>(tile, cleared, 0, kTile * kTile);
  clear_colors<R>(tile, cleared, 0, kTile * kTile);
  clear_bounds(tile, cleared);
  if (format.stencil != StencilFormat::none) std::fill_n(tile.stencil, kTile * kTile, format.clear_stencil);
}

/// Writes the tile to the frame and clears it, a row of blocks at a time: clearing costs little while streamed stores
/// wait for memory. By vectors where rows are whole ones, else by write_out(). One plane after the other: two streams
/// of stores are slower.
template <class R>
void move_out(const Painting& painting, PackedTile& tile, Frame& frame) {
  if (!has_whole_lanes<R>(frame, tile.x0)) {
    write_out(tile, frame);
    return clear<R>(tile, painting.format);
  }
  constexpr int kOfRow = kBlock * kTile;  // pixels of a row of blocks
  const ClearPixel cleared = clear_pixel(painting.format);
  const auto row = [](const float* blocks, int x, int y) {
    return Lanes<R>::load_row(blocks + block_offset(x, y) + y % kBlock * kBlock);
  };
  const auto* color = reinterpret_cast<const float*>(tile.color);
  for (int y = 0, i = 0; y < kTile; y += kBlock, i += kOfRow) {
    write_rows<R>(frame.color_rgba8, tile.x0, tile.y0, y, y + kBlock,
                  [&](int x, int of) { return as_int(row(color, x, of)); });
    clear_colors<R>(tile, cleared, i, i + kOfRow);
  }
  for (int y = 0, i = 0; y < kTile; y += kBlock, i += kOfRow) {
    write_rows<R>(frame.depth_code, tile.x0, tile.y0, y, y + kBlock,
                  [&](int x, int of) { return to_int(row(tile.depth, x, of)); });
    clear_depths<R>(tile, cleared, i, i + kOfRow);
  }
  clear_bounds(tile, cleared);
}

/// Stage 12: mean_of_four() (resolve.h) of the samples' codes, into samples[0], which keeps the first sample's depths.
template <class R>
void resolve_samples(PackedTile (&samples)[4]) {
  const R code(1.0f / 255.0f);
  for (int i = 0; i < kTile * kTile; i += Lanes<R>::width) {
    Color<R> sum = samples[0].at(i).load_color<R>() * code;
    for (int k = 1; k < 4; ++k) sum = sum + samples[k].at(i).load_color<R>() * code;
    const Color<R> mean = (sum * R(0.25f)) * R(255.0f);  // packed_codes() rounds it half to even
    store(packed_codes(mean.r, mean.g, mean.b, mean.a), reinterpret_cast<std::int32_t*>(samples[0].color + i));
  }
}

/// Sets the tile's lower left pixel to that of tile `number`, counted row by row.
void place(const Painting& painting, int number, auto& tile) {
  tile.x0 = number % painting.columns * kTile, tile.y0 = number / painting.columns * kTile;
}

/// Stages 5 to 12 of tile `number`, from the frame's clear values on, in `memory`. In rgba8 frames memory.packed[0]
/// must be clear, as write_tile() leaves it.
template <class R>
void paint_tile(const Painting& painting, int number, TileMemory& memory) {
  const auto begin = [&](auto& tile) {
    place(painting, number, tile);
    clear<R>(tile, painting.format);
  };
  const std::vector<PaintRun>& runs = memory.runs;
  find_runs(painting, static_cast<std::size_t>(number), memory.runs);
  PackedTile& first = memory.packed[0];
  place(painting, number, first);
  if (painting.format.color != ColorFormat::rgba8) {
    begin(memory.tile);
    for (const PaintRun& run : runs) paint_run<R>(painting, run, memory.tile);
  } else if (painting.samples.size() == 1) {
    std::size_t i = 0;
    if constexpr (kHasKernels<R>) i = paint_first_runs<R>(painting, runs, first);
    for (; i < runs.size(); ++i) paint_next_run<R, 1>(painting, runs[i], &first);
  } else if (!runs.empty()) {
    for (PackedTile& tile : std::span(memory.packed).subspan(1)) begin(tile);
    for (const PaintRun& run : runs) paint_next_run<R, 4>(painting, run, memory.packed);
    resolve_samples<R>(memory.packed);
  }
}

/// Writes the tile of the last paint_tile() to the frame; Lanes<R>::end_of_stream() makes its pixels visible to other
/// threads.
template <class R>
void write_tile(const Painting& painting, TileMemory& memory, Frame& frame) {
  if (painting.format.color != ColorFormat::rgba8) return write_out(memory.tile, frame);
  PackedTile& first = memory.packed[0];
  if (memory.runs.empty() && clear_out<R>(painting, first.x0, first.y0, frame)) return;
  move_out<R>(painting, first, frame);
}

/// Stages 5 to 12 of the tiles that the counter deals out, from their clear values into the frame.
template <class R>
void paint_tiles(const Painting& painting, TileCounter& tiles, TileMemory& memory, Frame& frame) {
  clear<R>(memory.packed[0], painting.format);
  for (TileCounter::Range of = tiles.claim(); of.begin < of.end; of = tiles.claim()) {
    for (int tile = of.begin; tile < of.end; ++tile) {
      paint_tile<R>(painting, tile, memory);
      write_tile<R>(painting, memory, frame);
    }
  }
  Lanes<R>::end_of_stream();
}

}  // namespace plumbline::pipeline

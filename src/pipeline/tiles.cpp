#include "pipeline/tiles.h"

#include "scene/antialias.h"

namespace plumbline::pipeline {

namespace {

// The tiles that a triangle's bounding box touches: [x0, x1) x [y0, y1), none if it holds no pixel of the frame.
PixelBounds tiles_of(const WindowTriangle<float>& triangle, const FrameFormat& frame) {
  const glm::ivec2 sample = sample_place(frame);
  const PixelBounds b = sample == glm::ivec2(0) ? pixel_bounds(triangle) : pixel_bounds(as_seen_from(triangle, sample));
  const int x0 = std::max(b.x0, 0), x1 = std::min(b.x1, frame.width);
  const int y0 = std::max(b.y0, 0), y1 = std::min(b.y1, frame.height);
  if (x0 >= x1 || y0 >= y1) return {0, 0, 0, 0};
  return {x0 / kTile, y0 / kTile, (x1 - 1) / kTile + 1, (y1 - 1) / kTile + 1};
}

template <class Visit>
void for_each_tile(const PixelBounds& tiles, int columns, Visit visit) {
  for (int y = tiles.y0; y < tiles.y1; ++y) {
    for (int x = tiles.x0; x < tiles.x1; ++x) visit(static_cast<std::size_t>(y * columns + x));
  }
}

}  // namespace

// A counting sort, stable, so that numbers ascend within each tile.
Bins bin(std::span<const WindowTriangle<float>> triangles, const FrameFormat& frame) {
  Bins bins;
  bins.columns = (frame.width + kTile - 1) / kTile;
  bins.rows = (frame.height + kTile - 1) / kTile;
  bins.first.assign(static_cast<std::size_t>(bins.columns * bins.rows) + 1, 0);
  for (const auto& triangle : triangles) {
    for_each_tile(tiles_of(triangle, frame), bins.columns, [&](std::size_t tile) { ++bins.first[tile + 1]; });
  }
  for (std::size_t i = 1; i < bins.first.size(); ++i) bins.first[i] += bins.first[i - 1];
  bins.numbers.resize(bins.first.back());
  std::vector<std::size_t> next(bins.first);
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    for_each_tile(tiles_of(triangles[n], frame), bins.columns,
                  [&](std::size_t tile) { bins.numbers[next[tile]++] = static_cast<std::uint32_t>(n); });
  }
  return bins;
}

Formats formats_of(const FrameFormat& frame) {
  return {depth_scale(frame.depth), static_cast<float>(color_scale(frame.color)), sample_place(frame)};
}

ClearPixel clear_pixel(const FrameFormat& frame, const Formats& formats) {
  const glm::vec4& c = frame.clear_color;
  const double z = formats.depth_scale == 0.0 ? frame.clear_depth : depth_code(frame.clear_depth, formats.depth_scale);
  return {static_cast<float>(z), merge<float>({c.r, c.g, c.b, c.a}, formats.color_scale)};
}

void clear(Tile& tile, const FrameFormat& frame, const Formats& formats) {
  const auto [depth, color] = clear_pixel(frame, formats);
  std::fill_n(tile.depth, kTile * kTile, depth);
  if (frame.stencil != StencilFormat::none) std::fill_n(tile.stencil, kTile * kTile, frame.clear_stencil);
  std::fill_n(tile.color[0], kTile * kTile, color.r);
  std::fill_n(tile.color[1], kTile * kTile, color.g);
  std::fill_n(tile.color[2], kTile * kTile, color.b);
  std::fill_n(tile.color[3], kTile * kTile, color.a);
}

namespace {

// Calls write(x, y, i) for each of the frame's pixels in the tile, i its place in the tile.
template <class Write>
void for_each_pixel(const auto& tile, int width, int height, Write write) {
  for (int y = tile.y0; y < std::min(tile.y0 + kTile, height); ++y) {
    for (int x = tile.x0; x < std::min(tile.x0 + kTile, width); ++x) {
      const int in_block = y % kBlock * kBlock + x % kBlock;
      write(x, y, tile.offset(x, y) + in_block);
    }
  }
}

template <class T, class Convert>
void copy_out(const auto& tile, Plane<T>& plane, Convert convert) {
  if (plane.empty()) return;
  for_each_pixel(tile, plane.width(), plane.height(), [&](int x, int y, int i) { plane(x, y) = convert(i); });
}

void copy_out_rest(const auto& tile, Frame& frame) {
  copy_out(tile, frame.stencil, [&](int i) { return tile.stencil[i]; });
  copy_out(tile, frame.depth_code, [&](int i) { return static_cast<std::uint32_t>(tile.depth[i]); });
  copy_out(tile, frame.depth_z32f, [&](int i) { return tile.depth[i]; });
}

}  // namespace

void write_out(const Tile& tile, Frame& frame) {
  const auto& c = tile.color;
  copy_out(tile, frame.color_rgba8, [&](int i) { return glm::u8vec4(c[0][i], c[1][i], c[2][i], c[3][i]); });
  copy_out(tile, frame.color_rgba12, [&](int i) { return glm::u16vec4(c[0][i], c[1][i], c[2][i], c[3][i]); });
  copy_out(tile, frame.color_rgba16, [&](int i) { return glm::u16vec4(c[0][i], c[1][i], c[2][i], c[3][i]); });
  copy_out(tile, frame.color_rgba32f, [&](int i) { return glm::vec4(c[0][i], c[1][i], c[2][i], c[3][i]); });
  copy_out_rest(tile, frame);
}

void write_out(const PackedTile& tile, Frame& frame) {
  copy_out(tile, frame.color_rgba8, [&](int i) {
    const std::uint32_t code = tile.color[i];
    return glm::u8vec4(code & 255u, code >> 8 & 255u, code >> 16 & 255u, code >> 24);
  });
  copy_out_rest(tile, frame);
}

BlockState block_state(const Draw& draw, DepthFormat format, bool depth_clamp, const Surface* surface) {
  return {depth_state(draw, format, depth_clamp),
          draw.depth_func,
          draw.scissor,
          draw.alpha_test,
          draw.stencil,
          draw.merge,
          surface};
}

TileList tile_list(const DrawList& list, const FrameFormat& format) {
  TileList out{list, format, formats_of(format), bin(list.triangles, format), {}};
  for (std::size_t d = 0; d < list.draws.size(); ++d) {
    const bool plain = list.surfaces.empty() || list.surfaces[d].plain();
    out.state_of.push_back(
        block_state(list.draws[d], format.depth, list.depth_clamp, plain ? nullptr : &list.surfaces[d]));
  }
  return out;
}

void each_tile(const TileList& work, Frame& frame, const std::function<void(std::size_t, Tile&)>& draw) {
  Tile tile{};
  const int tiles = work.bins.columns * work.bins.rows;
  for (int t = 0; t < tiles; ++t) {
    tile.x0 = t % work.bins.columns * kTile;
    tile.y0 = t / work.bins.columns * kTile;
    clear(tile, work.format, work.formats);
    draw(static_cast<std::size_t>(t), tile);
    write_out(tile, frame);
  }
}

}  // namespace plumbline::pipeline

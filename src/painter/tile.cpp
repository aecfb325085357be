#include "painter/tile.h"

#include <algorithm>

namespace plumbline::pipeline {

void clear(Tile& tile, const FrameFormat& frame) {
  const auto [depth, color] = clear_pixel(frame);
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

}  // namespace plumbline::pipeline

#include "painter/tile.h"

#include <algorithm>
#include <cstdint>

namespace plumbline::pipeline {

namespace {

void copy_blocks(auto& tile, Frame& frame) {
  const auto copy = [&](auto& plane, auto value_at) {
    for (int y = tile.y0; y < std::min(tile.y0 + kTile, plane.height()); ++y) {
      for (int x = tile.x0; x < std::min(tile.x0 + kTile, plane.width()); ++x) {
        plane(x, y) = value_at(pixel_offset(x - tile.x0, y - tile.y0));
      }
    }
  };
  const auto copy_colors = [&]<class T>(Plane<T>& plane) {
    copy(plane, [&](int place) {
      const Color<float> c = tile.at(place).template load_color<float>();
      return T(c.r, c.g, c.b, c.a);
    });
  };
  copy_colors(frame.color_rgba8), copy_colors(frame.color_rgba16), copy_colors(frame.color_rgba32f);
  copy(frame.depth_code, [&](int place) { return static_cast<std::uint32_t>(tile.depth[place]); });
  copy(frame.depth_z32f, [&](int place) { return tile.depth[place]; });
  copy(frame.stencil, [&](int place) { return tile.stencil[place]; });
}

}  // namespace

void write_out(Tile& tile, Frame& frame) { copy_blocks(tile, frame); }
void write_out(PackedTile& tile, Frame& frame) { copy_blocks(tile, frame); }

}  // namespace plumbline::pipeline

#include "notes/raster/triangle_spans.h"

#include <stdexcept>

#include <fmt/format.h>

namespace plumbline::raster {

void append_pixel(int x, int y, Spans& out) {
  if (!out.empty() && out.back().y == y && out.back().end == x) {
    ++out.back().end;
  } else {
    out.push_back({y, x, x + 1});
  }
}

void require_in_range(const Corners& corners, int width, int height) {
  constexpr int kFarthest = 1 << 29, kLargestSide = 16384;
  for (const glm::ivec2& p : corners) {
    for (const int v : {p.x, p.y}) {
      if (v >= -kFarthest && v <= kFarthest) continue;
      throw std::out_of_range(fmt::format("expected corners within +-{} (1/256 pixel), found {}", kFarthest, v));
    }
  }
  for (const int side : {width, height}) {
    if (side >= 1 && side <= kLargestSide) continue;
    throw std::out_of_range(fmt::format("expected frame sides from 1 to {}, found {}", kLargestSide, side));
  }
}

}  // namespace plumbline::raster

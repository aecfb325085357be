// Stages 5 to 11 of one triangle, line or point at a time: those that do not fit lanes (set_up_lanes.h).
#pragma once

#include <algorithm>

#include "painter/fragments.h"

namespace plumbline::pipeline {

struct LoneSetup {
  bool front;
  Edges edges;
  BarycentricPlanes planes;
  DepthPlane depth_plane;
  PerspectiveSetup perspective;
  AttributeSetup attributes;
};
/// For the tile whose lower left pixel is `anchor`. `color`: at the corners.
inline LoneSetup set_up(const WindowTriangle& t, const std::array<Vec4<float>, 3>& color, const DepthState& state,
                        glm::ivec2 sample, glm::ivec2 anchor) {
  const BarycentricPlanes planes = planes_of(t, anchor.x, anchor.y);
  const DepthPlane plane = depth_plane(depth_setup(t, state), planes);
  return {t.front,
          edges_of(as_seen_from(t, sample)),
          planes,
          moved(plane, sample),
          perspective_setup(t, planes),
          attribute_setup(color)};
}

/// The fragments of a line or point, in their order; those that follow each other and lie in the same lanes, together.
template <class R>
void paint_line_or_point(const DrawState& state, const WindowTriangle& line_or_point, const LoneSetup& s,
                         const SurfaceSetup* surface, float color_scale, auto& tile) {
  constexpr int kLanes = Lanes<R>::width;
  glm::ivec2 block(0);  // the lanes' own: its first pixel, and the first lane's place in it
  int first = 0;
  unsigned lanes = 0;
  const auto paint = [&] {
    if (lanes == 0) return;
    paint_fragments<R>(state, s, surface, block_pixels<R>(block.x, block.y, first), mask_of<R>(lanes),
                       tile.offset(block.x, block.y) + first, color_scale, tile);
  };
  visit_line_or_point(line_or_point, {tile.x0, tile.y0}, glm::ivec2(kTile), [&](glm::ivec2 pixel) {
    const glm::ivec2 at = pixel & (kBlock - 1);
    const int place = at.y * kBlock + at.x, lane = place & (kLanes - 1);
    if (pixel - at != block || place - lane != first || (lanes >> lane & 1u) != 0) {
      paint();
      block = pixel - at, first = place - lane, lanes = 0;
    }
    lanes |= 1u << lane;
  });
  paint();
}

/// `varying_at(v)`: varying v at the corners, where the draw has a surface.
template <class R>
void paint_lone(const DrawState& state, const WindowTriangle& t, const std::array<Vec4<float>, 3>& color,
                const auto& varying_at, const Formats& formats, auto& tile) {
  const LoneSetup s = set_up(t, color, state.depth, formats.sample, {tile.x0, tile.y0});
  SurfaceSetup of_surface;
  const SurfaceSetup* surface = nullptr;
  if (state.surface != nullptr) {
    of_surface = set_up_surface(*state.surface, t, s.planes, varying_at);
    surface = &of_surface;
  }
  if (t.corners < 3) return paint_line_or_point<R>(state, t, s, surface, formats.color_scale, tile);
  const PixelBounds bounds = pixel_bounds(as_seen_from(t, formats.sample));
  const int x0 = std::max(bounds.x0, tile.x0) & ~(kBlock - 1), x1 = std::min(bounds.x1, tile.x0 + kTile);
  const int y0 = std::max(bounds.y0, tile.y0) & ~(kBlock - 1), y1 = std::min(bounds.y1, tile.y0 + kTile);
  for (int y = y0; y < y1; y += kBlock) {
    for (int x = x0; x < x1; x += kBlock) {
      for (int i = 0; i < kBlockPixels; i += Lanes<R>::width) {
        const Pixels<R> p = block_pixels<R>(x, y, i);
        const Mask<R> covered = coverage<R>(s.edges, p);
        if (any(covered)) {
          paint_fragments<R>(state, s, surface, p, covered, tile.offset(x, y) + i, formats.color_scale, tile);
        }
      }
    }
  }
}

}  // namespace plumbline::pipeline

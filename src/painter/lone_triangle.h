// Stages 5 to 11 of one triangle, line or point at a time: those that do not fit lanes (set_up_lanes.h).
#pragma once

#include <algorithm>

#include "painter/fragments.h"
#include "pipeline/triangle_setup.h"

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

/// Pixel by pixel. `varying_at(v)`: varying v at the corners, where the draw has a surface.
void paint_lone(const DrawState& state, const WindowTriangle& t, const std::array<Vec4<float>, 3>& color,
                const auto& varying_at, const Formats& formats, auto& tile) {
  const LoneSetup s = set_up(t, color, state.depth, formats.sample, {tile.x0, tile.y0});
  SurfaceSetup of_surface;
  const SurfaceSetup* surface = nullptr;
  if (state.surface != nullptr) {
    of_surface = set_up_surface(*state.surface, t, s.planes, varying_at);
    surface = &of_surface;
  }
  const auto paint = [&](glm::ivec2 p) {
    const int place = tile.offset(p.x, p.y) + p.y % kBlock * kBlock + p.x % kBlock;
    paint_fragments<float>(state, s, surface, pixel_at(p), true, place, formats.color_scale, tile);
  };
  if (t.corners < 3) return visit_line_or_point(t, {tile.x0, tile.y0}, glm::ivec2(kTile), paint);
  const PixelBounds bounds = pixel_bounds(as_seen_from(t, formats.sample));
  for (int y = std::max(bounds.y0, tile.y0); y < std::min(bounds.y1, tile.y0 + kTile); ++y) {
    for (int x = std::max(bounds.x0, tile.x0); x < std::min(bounds.x1, tile.x0 + kTile); ++x) {
      if (coverage<float>(s.edges, {x, y, 0, 0})) paint({x, y});
    }
  }
}

}  // namespace plumbline::pipeline

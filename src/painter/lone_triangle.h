// Stages 5 to 11 of one triangle, line or point at a time: those that do not fit lanes (set_up_lanes.h).
#pragma once

#include <algorithm>

#include "painter/painting.h"
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
void paint_lone(const PaintDraw& draw, const WindowTriangle& t, const std::array<Vec4<float>, 3>& color,
                const auto& varying_at, const Formats& formats, auto& tile) {
  const LoneSetup s = set_up(t, color, draw.depth, formats.sample, {tile.x0, tile.y0});
  SurfaceSetup of_surface;
  const SurfaceSetup* surface = nullptr;
  if (draw.surface != nullptr) {
    of_surface = set_up_surface(*draw.surface, t, s.planes, varying_at);
    surface = &of_surface;
  }
  const auto paint = [&](glm::ivec2 p) {
    const int place = tile.offset(p.x, p.y) + p.y % kBlock * kBlock + p.x % kBlock;
    paint_fragments<float>(*draw.draw, s, surface, pixel_at(p), true, place, formats.color_scale, tile);
  };
  if (t.corners < 3) return visit_line_or_point(t, {tile.x0, tile.y0}, glm::ivec2(kTile), paint);
  const PixelBounds bounds = pixel_bounds(as_seen_from(t, formats.sample));
  for (int y = std::max(bounds.y0, tile.y0); y < std::min(bounds.y1, tile.y0 + kTile); ++y) {
    for (int x = std::max(bounds.x0, tile.x0); x < std::min(bounds.x1, tile.x0 + kTile); ++x) {
      if (coverage<float>(s.edges, {x, y, 0, 0})) paint({x, y});
    }
  }
}

/// A triangle's varyings at its corners; of those that light made, flat shading takes the provoking one's.
inline std::array<Vec4<float>, 3> varying_of(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t,
                                             Varying v) {
  const Vec4<float>* column = painting.varyings[static_cast<std::size_t>(v)];
  const bool flat = draw.flat() && is_lit(v);
  return {column[t.corner[flat ? 1 : 0]], column[t.corner[1]], column[t.corner[flat ? 1 : 2]]};
}

/// The triangle as stage 4 has it.
inline WindowTriangle window_triangle_of(const Painting& painting, const PaintTriangle& t) {
  WindowTriangle out{{}, 0, t.front, t.corners, t.width};
  for (std::size_t k = 0; k < 3; ++k) {
    const PaintVertex& v = painting.vertices[t.corner[k]];
    out.v[k] = {v.p_win, v.inv_w, v.snapped};
  }
  return out;
}
/// Its colours at the corners.
inline std::array<Vec4<float>, 3> colors_of(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t) {
  const auto color = [&](int k) { return painting.vertices[t.corner[draw.flat() ? 1 : k]].color; };
  return {color(0), color(1), color(2)};
}

/// (x0, y0): the tile's lower left pixel.
inline SurfaceSetup surface_of_lane(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t, int x0,
                                    int y0) {
  const auto varying = [&](Varying v) { return varying_of(painting, draw, t, v); };
  const WindowTriangle triangle = window_triangle_of(painting, t);
  return set_up_surface(*draw.surface, triangle, planes_of(triangle, x0, y0), varying);
}

/// A triangle, line or point of the painting.
void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, auto& tile) {
  const auto varying = [&](Varying v) { return varying_of(painting, draw, triangle, v); };
  paint_lone(draw, window_triangle_of(painting, triangle), colors_of(painting, draw, triangle), varying,
             painting.formats, tile);
}

/// paint(painting, tile) of each sample's own.
template <int kSampleCount>
void each_sample(const Painting& painting, PackedTile* tiles, auto paint) {
  if constexpr (kSampleCount == 1) return paint(painting, tiles[0]);
  for (std::size_t i = 0; i < kSampleCount; ++i) {
    Painting of_sample = painting;
    of_sample.samples = painting.samples.subspan(i, 1);
    of_sample.formats.sample = painting.samples[i];
    paint(of_sample, tiles[i]);
  }
}

/// The same in the tile of each sample.
template <int kSampleCount>
void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, PackedTile* tiles) {
  each_sample<kSampleCount>(painting, tiles,
                            [&](const Painting& of, PackedTile& tile) { paint_alone(of, draw, triangle, tile); });
}

}  // namespace plumbline::pipeline

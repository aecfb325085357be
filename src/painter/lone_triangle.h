// One primitive as the definition's records have it; and stages 5 to 11, one at a time, of those that do not fit lanes
// (set_up_lanes.h).
#pragma once

#include <optional>

#include "kernels/coverage.h"
#include "painter/painting.h"
#include "pipeline/fragment.h"

namespace plumbline::pipeline {

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

/// Varyings of a draw's triangle; none without a surface. `gradients`: of its texture coordinates, if it has a texture.
inline std::optional<SurfaceSetup> surface_setup(const Painting& painting, const PaintDraw& draw,
                                                 const PaintTriangle& t, const GradientSetup& gradients) {
  if (draw.surface == nullptr) return {};
  SurfaceSetup out{draw.surface, {}, {}};
  for (const Varying v : draw.surface->carried) {
    out.varyings[static_cast<std::size_t>(v)] = attribute_setup(varying_of(painting, draw, t, v));
  }
  if (draw.surface->texture) out.gradients = gradients;
  return out;
}

/// Stages 5 to 11 of a triangle, line or point, pixel by pixel.
void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, Tile& tile);
void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, PackedTile& tile);

/// Calls paint(painting, tile) for each sample: the painting with that sample alone, and the sample's tile.
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

}  // namespace plumbline::pipeline

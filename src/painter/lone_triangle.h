// One primitive of the painter in the definition's records; and stages 5 to 11, pixel by pixel, of a primitive that
// does not fit lanes (set_up_lanes.h).
#pragma once

#include <optional>

#include "kernels/coverage.h"
#include "painter/painting.h"
#include "pipeline/fragment.h"

namespace plumbline::pipeline {

/// Values of a varying at a triangle's corners. Under flat shading all corners have a lit varying's value at the
/// provoking vertex, corner 1.
inline std::array<Vec4<float>, 3> varying_of(const Painting& painting, const PaintDraw& draw, const PaintTriangle& t,
                                             Varying v) {
  const Vec4<float>* column = painting.varyings[index_of(v)];
  const bool flat = draw.flat() && is_lit(v);
  return {column[t.corner[flat ? 1 : 0]], column[t.corner[1]], column[t.corner[flat ? 1 : 2]]};
}

/// Record of stage 4 for the triangle; the record's primitive number is left 0.
inline WindowTriangle window_triangle_of(const Painting& painting, const PaintTriangle& t) {
  WindowTriangle out{{}, 0, t.front, t.corners, t.width};
  for (std::size_t k = 0; k < 3; ++k) {
    const PaintVertex& v = painting.vertices[t.corner[k]];
    out.v[k] = {v.p_win, v.inv_w, painting.snapped[t.corner[k]]};
  }
  return out;
}

/// Surface setup of a draw's triangle; none without a surface. `gradients`: of the texture coordinates; read only with
/// a texture.
inline std::optional<SurfaceSetup> surface_setup(const Painting& painting, const PaintDraw& draw,
                                                 const PaintTriangle& t, const GradientSetup& gradients) {
  if (draw.surface == nullptr) return {};
  SurfaceSetup out{draw.surface, {}, {}};
  for (const Varying v : draw.surface->carried) {
    out.varyings[index_of(v)] = attribute_setup(varying_of(painting, draw, t, v));
  }
  if (draw.surface->texture) out.gradients = gradients;
  return out;
}

/// Stages 5 to 11 of a triangle, line or point in the tile, pixel by pixel, under any state.
void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, Tile& tile);
void paint_alone(const Painting& painting, const PaintDraw& draw, const PaintTriangle& triangle, PackedTile& tile);

/// Calls paint(painting, tile) for each sample, with a copy of the painting that has this sample alone. `tiles`: one
/// for each sample.
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

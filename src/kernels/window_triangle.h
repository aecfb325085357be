// A triangle, line or point in window space: its geometry, without attributes.
#pragma once

#include <array>
#include <cstdint>

#include "capture/stages.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

struct WindowVertex {
  Vec3<float> p_win;   ///< x, y [pixels]; z in [0,1] but for rounding, any finite number under depth clamp
  float inv_w;         ///< 1 / w_clip
  glm::ivec2 snapped;  ///< [1/256 pixel], pixel (i, j)'s centre is (256 i, 256 j)
};

/// Window triangle, line (the last corner repeated) or point (three equal corners).
struct WindowTriangle {
  std::array<WindowVertex, 3> v;
  std::uint32_t primitive = 0;
  bool front = true;          ///< facing: of an outline, the polygon's; of a mesh's line or point, true
  std::uint32_t corners = 3;  ///< of a line 2, of a point 1
  std::uint32_t width = 1;    ///< line width, or side of a point's square [pixels]
};

/// Snapped coordinate (win - 1/2) * 256, half to even, for |win| <= 2^20. The difference is exact in double for |win|
/// >= 2^-30, and no smaller |win| leads half way between two integers; adding 1.5 * 2^52 rounds half to even.
inline int snap(float win) {
  constexpr double kRound = 6755399441055744.0;
  return static_cast<int>(((static_cast<double>(win) - 0.5) * kSubpixel + kRound) - kRound);
}

/// Twice the snapped area [2^-16 pixel^2]; > 0: counter-clockwise in the window, a front face.
inline std::int64_t snapped_area(const WindowTriangle& t) {
  const glm::i64vec2 a(t.v[0].snapped), b(t.v[1].snapped), c(t.v[2].snapped);
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Splits a convex polygon of `count` corners into the primitives that the draw does not cull. area(i): twice the
/// snapped area of triangle (i - 1, i, 0) of the polygon's fan. The sum of the areas (0: back) decides the
/// polygon's mode and, unless both modes are fill, culling. Filled: calls triangle(i, front) for each triangle of the
/// fan that has an area, faced and culled by its own area. Else calls line(a, b, front) for each edge, or point(a,
/// front) for each corner, faced as the polygon.
void visit_polygon(const Draw& draw, std::size_t count, auto area, auto triangle, auto line, auto point) {
  const auto culled = [&](bool front) { return draw.cull != Cull::none && front == (draw.cull == Cull::front); };
  std::int64_t sum = 0;
  for (std::size_t i = 2; i < count; ++i) sum += area(i);
  const bool front = sum > 0, filled = is_filled(draw);
  const PolygonMode mode = filled ? PolygonMode::fill : front ? draw.front_mode : draw.back_mode;
  if (!filled && culled(front)) return;
  for (std::size_t i = 2; i < count && mode == PolygonMode::fill; ++i) {
    const std::int64_t of_triangle = area(i);
    if (of_triangle != 0 && !culled(of_triangle > 0)) triangle(i, of_triangle > 0);
  }
  for (std::size_t i = 0; i < count && mode == PolygonMode::line; ++i) line(i == 0 ? count - 1 : i - 1, i, front);
  for (std::size_t i = 0; i < count && mode == PolygonMode::point; ++i) point(i, front);
}

}  // namespace plumbline::pipeline

// Stages 5 to 11 of lines whose nearer fragments replace the stored ones, in frames of rgba8 and z24. As many lines of
// width 1 as there are lanes are set up together, and then coloured together, pixel by pixel.
#pragma once

#include <algorithm>

#include "kernels/line_diamond.h"
#include "painter/lone_triangle.h"
#include "painter/paint_pixels.h"
#include "painter/visit_covered.h"

namespace plumbline::pipeline {

/// planes_of() of each lane's line (depth.cpp). NaN for a line without length, which covers nothing.
template <class R>
[[gnu::always_inline]] inline CornerPlanes<Wide<R>> planes_of_lines(const Vec4<R> (&p_win)[3], glm::ivec2 tile) {
  using W = Wide<R>;
  const PlaneCorners<W> line =
      line_corners(to_wide(p_win[0][0]), to_wide(p_win[0][1]), to_wide(p_win[1][0]), to_wide(p_win[1][1]));
  CornerPlanes<W> planes = corner_planes(line, tile.x + 0.5, tile.y + 0.5);
  planes.l2 = {W(0), W(0), W(0)};
  return planes;
}

/// Paints a run of lines. A group of lanes with a line wider than 1 pixel is painted one by one.
template <class R>
void paint_lines(const Painting& painting, const PaintRun& run, PackedTile& tile) {
  constexpr int kLanes = Lanes<R>::width;
  const PaintDraw& draw = painting.draws[run.draw];
  const glm::i64vec2 origin = std::int64_t{kSubpixel} * glm::i64vec2(tile.x0, tile.y0);
  LanesOfRun<R, 1> lines(painting, run, false, tile.x0, tile.y0);
  alignas(64) std::int32_t pixel_of[kTile][kLanes] = {};  // x + kTile y; stale behind a line's last pixel
  while (lines.next()) {
    bool all_fit = true;
    for (int lane = 0; lane < lines.count; ++lane) all_fit &= lines.triangle(lane).width == 1;
    if (!all_fit) {
      for (int lane = 0; lane < lines.count; ++lane) paint_alone(painting, draw, lines.triangle(lane), tile);
      continue;
    }
    int pixels[kLanes] = {}, most = 0;
    for (int lane = 0; lane < lines.count; ++lane) {
      const auto end = [&](int k) { return glm::i64vec2(painting.snapped[lines.corner[k][lane]]) - origin; };
      int& n = pixels[lane];
      raster::visit_diamond_exit_line(end(0), end(1), glm::ivec2(kTile),
                                      [&](glm::ivec2 p) { pixel_of[n++][lane] = p.x + kTile * p.y; });
      most = std::max(most, n);
    }
    if (most == 0) continue;
    std::copy_n(lines.corner[0], kLanes, lines.corner[2]);
    const CornerLanes<R> corners = load_corners<R>(painting, lines.corner);
    set_up_colors<R>(painting, lines.corner, draw.flat(), lines.lanes);
    set_up_planes<R>(planes_of_lines<R>(corners.p_win, {tile.x0, tile.y0}), corners.p_win, painting, lines.lanes);
    PixelsOfLanes<R, PixelColors::own, false, kTile> values(lines.lanes, 0);
    for (int k = 0; k < most; ++k) {
      const Int<R> pixel = Lanes<R>::load(pixel_of[k]);
      values.work_out(k, pixel & Int<R>(kTile - 1), shifted_right<6>(pixel));
    }
    for (int lane = 0; lane < lines.count; ++lane) values.paint(lane, pixels[lane], false, 0, tile);
  }
}

}  // namespace plumbline::pipeline

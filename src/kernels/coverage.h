// Stage 5: which pixel centres a triangle covers.
//
//            c          Each edge has a function E(x, y) = (b - a) x ((x, y) - a), positive on its left. Corners are
//           / \         taken counter-clockwise, so a centre is inside where all three are positive. A centre with
//          / + \        E = 0 lies on the edge: the tie rule gives it to one of the two triangles that share the edge,
//         /     \       so that each centre is painted once.
//        a ----- b
//
// Positions are integers in 1/256 pixel (Pineda, A parallel algorithm for polygon rasterization, SIGGRAPH 1988), so
// every E is exact: corners lie within 2^28 (stage 4), |E| below 2^59 over frames of up to 16384 pixels a side.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/lanes.h"
#include "kernels/line_diamond.h"
#include "kernels/window_triangle.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Three edge functions over pixel numbers: E_i(x, y) = at_origin[i] + step_x[i] x + step_y[i] y, less 1 where the tie
/// rule does not give centres on edge i to the triangle. A pixel is covered where all three are >= 0.
struct Edges {
  std::int64_t at_origin[3];
  std::int64_t step_x[3];
  std::int64_t step_y[3];
};

/// `triangle`: three corners.
Edges edges_of(const WindowTriangle& triangle);

/// The triangle moved by -sample [1/256 pixel]: it covers a pixel's centre where the given triangle covers the sample
/// at centre + sample. Lines and points are not moved: their coverage is the centre's in every pass.
inline WindowTriangle as_seen_from(const WindowTriangle& triangle, glm::ivec2 sample) {
  WindowTriangle out = triangle;
  for (WindowVertex& v : out.v) v.snapped -= triangle.corners == 3 ? sample : glm::ivec2(0);
  return out;
}

/// Box of pixels [x0, x1) x [y0, y1); empty where x0 >= x1 or y0 >= y1.
struct PixelBounds {
  int x0, y0, x1, y1;
};
/// Pixels whose centres lie in the triangle's bounding box; of a line or point, all that it may cover, and some more.
PixelBounds pixel_bounds(const WindowTriangle& triangle);
inline PixelBounds intersection(const PixelBounds& a, const PixelBounds& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// Calls visit(pixel) for each pixel of a line (line_diamond.h), in the order of its steps, or of a point, row by row,
/// that lies in the box of `size` pixels from pixel `origin` on.
///
/// A wide line is moved down its minor axis by (width - 1) / 2; each of its pixels is the lowest of `width` pixels in a
/// column (y-major: the leftmost in a row; OpenGL 2.1, section 3.4.2). A wide point is a square of width x width
/// pixels, about the centre of the pixel that holds the point or, for an even width, about the nearest corner of pixels
/// (section 3.3). In both cases the first column is floor(x - (width - 1) / 2), the first row floor(y - (width - 1) /
/// 2).
void visit_line_or_point(const WindowTriangle& line_or_point, glm::ivec2 origin, glm::ivec2 size, auto visit) {
  const glm::i64vec2 from = std::int64_t{kSubpixel} * glm::i64vec2(origin);
  const glm::i64vec2 a = glm::i64vec2(line_or_point.v[0].snapped) - from;
  const glm::i64vec2 b = glm::i64vec2(line_or_point.v[1].snapped) - from;
  const auto width = static_cast<int>(line_or_point.width);
  if (line_or_point.corners == 1) {
    const glm::ivec2 first((a + std::int64_t{kSubpixel / 2 * (2 - width)}) >> std::int64_t{8});
    for (int y = std::max(first.y, 0); y < std::min(first.y + width, size.y); ++y) {
      for (int x = std::max(first.x, 0); x < std::min(first.x + width, size.x); ++x) visit(origin + glm::ivec2(x, y));
    }
    return;
  }
  const glm::i64vec2 d = glm::abs(b - a);
  const int minor = d.x >= d.y ? 1 : 0;
  // Walk the line width - 1 pixels higher, in a box width - 1 pixels taller, to visit pixels below the box, too.
  glm::i64vec2 moved(0);
  moved[minor] = kSubpixel * (width - 1) - kSubpixel / 2 * (width - 1);
  glm::ivec2 box = size;
  box[minor] += width - 1;
  raster::visit_diamond_exit_line(a + moved, b + moved, box, [&](glm::ivec2 p) {
    p[minor] -= width - 1;
    for (int k = 0; k < width; ++k, ++p[minor]) {
      if (p[minor] >= 0 && p[minor] < size[minor]) visit(origin + p);
    }
  });
}

/// Whether all three edge functions are >= 0 at pixel (p.x, p.y). Int<R> has to hold Edges' numbers: R = float.
template <class R>
Mask<R> coverage(const Edges& e, const Pixels<R>& p) {
  const auto at = [&](int i) { return e.at_origin[i] + e.step_x[i] * p.x + e.step_y[i] * p.y; };
  return (at(0) | at(1) | at(2)) >= 0;  // the sign bit of any
}

/// Calls visit(pixel) for the pixels of the box that the edges cover: row by row from the bottom, from left to right.
void visit_inside(const Edges& edges, const PixelBounds& box, auto visit) {
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      if (coverage<float>(edges, {x, y, 0, 0})) visit(glm::ivec2(x, y));
    }
  }
}

/// Pixels of the scissor box that the frame has.
PixelBounds scissored(const Scissor& box, const PixelBounds& frame);

/// Pixels of `box` that the triangle, line or point covers: row by row from the bottom, from left to right.
std::vector<glm::ivec2> covered_pixels(const WindowTriangle& triangle, const PixelBounds& box);
/// Pixels in both `bounds` and `box` that the edges cover: row by row from the bottom, from left to right.
std::vector<glm::ivec2> covered_pixels(const Edges& edges, const PixelBounds& bounds, const PixelBounds& box);

/// All pixels of the frame.
PixelBounds bounds_of(const FrameFormat& frame);

/// Mask of the pixels in the scissor box.
template <class R>
Mask<R> scissor(const Scissor& box, const Pixels<R>& p) {
  return (p.x >= box.x) & (p.x < box.x + box.width) & (p.y >= box.y) & (p.y < box.y + box.height);
}

}  // namespace plumbline::pipeline

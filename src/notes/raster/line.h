// The notes' three line algorithms (CSCI-580 notes, class 2 and 3, "Rasterizing Lines"): which pixels lie closest to a
// line between two pixels, with no gap.
//
// The notes treat x1 - x0 >= y1 - y0 >= 0 and "otherwise just exchange x and y". Here each line is turned into that
// octant, start at the origin, drawn, and turned back: (n, a) is its end there, k = a / n its slope, d = 0. A step is E
// (one along the major axis) or NE (one along both). Where the line passes exactly half way between two pixels, all
// three take E, so that all eight octants are mirror images of each other; the same line from its other end may
// differ, at such ties alone.
//
// Both ends are drawn; a line of no length is one pixel. The frame cuts only what is seen: the pixels that are left
// are those of the whole line.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace plumbline::raster {

/// An end of a line, or a pixel of it.
struct LinePixel {
  glm::ivec2 pixel;  ///< an end's coordinates: within +-2^29
  float depth;
  glm::vec4 color;
};

/// The algorithms: the line's pixels within [0, frame.x) x [0, frame.y), from `from` to `to`; one for each step along
/// the major axis. Depth and colour are affine in that step. Throws std::invalid_argument where an end is out of range.

/// y = ROUND(k x + d) for each x, the product and the quotient exact in integers.
std::vector<LinePixel> brute_force_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame);

/// y = y + k for each x, in float: "cumulative error buildup", up to 16 pixels over 32,767 steps. It never jumps into
/// the frame, and takes the whole line's time.
std::vector<LinePixel> incremental_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame);

/// The sign of f(M) = a x + b y + c at the middle M of the next two pixels says which is closer. Twice f, for the
/// notes' "constant integer" b / 2 is none where b is odd. Equal to brute_force_line, pixel for pixel.
std::vector<LinePixel> midpoint_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame);

}  // namespace plumbline::raster

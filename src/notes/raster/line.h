// The notes' three line algorithms (CSCI-580 notes, class 2 and 3, "Rasterizing Lines"): the pixels closest to a line
// between two pixels, without gaps.
//
// The notes treat x1 - x0 >= y1 - y0 >= 0 and "otherwise just exchange x and y". Each line is reflected into that
// octant with its start at the origin, drawn, and reflected back: in the octant the end is (n, a), the slope k = a / n,
// d = 0. A step is E (one along the major axis) or NE (one along both). Where the line passes exactly half way between
// two pixels, all three algorithms take E, so that the eight octants are mirror images of each other; a line drawn from
// its other end may differ, at such ties alone.
//
// Both ends are drawn; a line of length 0 is one pixel. The frame does not move the line: clipping only drops pixels
// beyond the frame.
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

// The three algorithms return the line's pixels within [0, frame.x) x [0, frame.y), from `from` to `to`, one per step
// along the major axis. Depth and colour are affine in the step. They throw std::invalid_argument where an end is out
// of range.

/// y = ROUND(k x + d) for each x, the product and the quotient exact in integers.
std::vector<LinePixel> brute_force_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame);

/// y = y + k for each x, in float: "cumulative error buildup", up to 16 pixels over 32,767 steps. Steps begin at the
/// line's start, outside of the frame too.
std::vector<LinePixel> incremental_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame);

/// The sign of f(M) = a x + b y + c at the middle M of the next two pixels selects the closer one. Computes 2 f: the
/// notes' "constant integer" b / 2 is no integer where b is odd. Equal to brute_force_line, pixel for pixel.
std::vector<LinePixel> midpoint_line(const LinePixel& from, const LinePixel& to, glm::ivec2 frame);

}  // namespace plumbline::raster

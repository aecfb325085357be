// OpenGL's lines of width 1 (OpenGL 2.1, section 3.4.1): the diamond-exit rule, exact in integers.
//
//    |   /\   |     A line produces the pixels whose diamond |x - xc| + |y - yc| < 1/2 it exits: those that it meets,
//    |  /  \  |     less the one that its end is in. Both ends are moved by -(e, e^2), e infinitely small, so that no
//    | / .  \ |     end and no line is ever on a border: of the border, a diamond then owns its right corner and its
//    | \    / |     two right sides without the corners at top and bottom.
//    |  \  /  |
//    |   \/   |     An x-major line (|dx| >= |dy|) crosses each column's middle within one diamond, and may miss it
//    +--------+     only where it starts after the middle, or ends before it.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline::raster {

/// Integer DDA of a line. A step of `toward` along the major axis adds `step` to the remainder `rest`; where `rest`
/// leaves [0, divisor), the minor coordinate moves by one.
struct DiamondSteps {
  int major;            ///< axis
  std::int64_t count;   ///< steps, one pixel each; 0: no pixel
  glm::i64vec2 pixel;   ///< first pixel
  std::int64_t toward;  ///< 1 or -1
  std::int64_t rest, step, divisor;
};
/// Steps of the line from `a` to `b` over the columns (y-major: rows) of the frame; their minor coordinate may lie
/// outside of it. Units, range and error: visit_diamond_exit_line().
DiamondSteps diamond_steps(glm::i64vec2 a, glm::i64vec2 b, glm::ivec2 frame);

/// Calls visit(pixel) for the pixels of the line from `a` to `b` within [0, frame.x) x [0, frame.y), in the order in
/// which they are exited. Ends [1/256 pixel]: pixel (i, j)'s centre is (256 i, 256 j); within +-2^29, else throws
/// std::invalid_argument.
void visit_diamond_exit_line(glm::i64vec2 a, glm::i64vec2 b, glm::ivec2 frame, auto visit) {
  const DiamondSteps s = diamond_steps(a, b, frame);
  const int minor = 1 - s.major;
  glm::i64vec2 p = s.pixel;
  std::int64_t rest = s.rest;
  for (std::int64_t i = 0; i < s.count; ++i, p[s.major] += s.toward) {
    if (p[minor] >= 0 && p[minor] < frame[minor]) visit(glm::ivec2(p));
    rest += s.step;  // by at most the divisor
    if (rest >= s.divisor) {
      rest -= s.divisor, ++p[minor];
    } else if (rest < 0) {
      rest += s.divisor, --p[minor];
    }
  }
}
/// Pixels of visit_diamond_exit_line(), in its order.
std::vector<glm::ivec2> diamond_exit_line(glm::i64vec2 a, glm::i64vec2 b, glm::ivec2 frame);

}  // namespace plumbline::raster

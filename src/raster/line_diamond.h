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

/// The pixels of the line from `a` to `b` within [0, frame.x) x [0, frame.y), in the order in which they are exited.
/// Ends in 1/256 pixel, pixel (i, j)'s centre at (256 i, 256 j), within +-2^29; std::invalid_argument beyond.
std::vector<glm::ivec2> diamond_exit_line(glm::i64vec2 a, glm::i64vec2 b, glm::ivec2 frame);

}  // namespace plumbline::raster

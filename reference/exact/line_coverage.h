// OpenGL's diamond-exit rule for lines (OpenGL 2.1, section 3.4.1), by its definition: each pixel's diamond is
// intersected with the segment.
//
// The diamond R_f = {|x - xf| + |y - yf| < 1/2} is the intersection of four open half planes. The segment's ends are
// p - (e, e^2), with e so small that any smaller e gives the same fragments: e is a symbol, and numbers are polynomials
// c0 + c1 e + c2 e^2, compared by the first coefficient that differs. No end is on a border. In terms of unmoved ends,
// a diamond owns the part of its border with x > xf, which the move brings inside: the right corner and the open right
// sides; not the top and bottom corners, not the left sides.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline::exact {

/// Diamond-exit rule: true if the segment from `a` to `b` meets the pixel's diamond and does not end in it. Ends
/// [1/256 pixel, pixel (i, j)'s centre at (256 i, 256 j), within +-2^40].
bool produces(glm::i64vec2 a, glm::i64vec2 b, glm::i64vec2 pixel);

/// All pixels within `width` x `height` of a line `w` pixels wide (section 3.4.2), by y, then x: the segment is moved
/// by -(w - 1)/2 along its minor axis, and each fragment becomes a column of w fragments upwards (y-major: a row
/// rightwards).
std::vector<glm::ivec2> wide_line_pixels(glm::i64vec2 a, glm::i64vec2 b, int w, int width, int height);

/// All pixels within `width` x `height` that the segment produces, by y, then x. Ends as for produces().
std::vector<glm::ivec2> line_pixels(glm::i64vec2 a, glm::i64vec2 b, int width, int height);

}  // namespace plumbline::exact

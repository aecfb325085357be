// OpenGL's diamond-exit rule for lines (OpenGL 2.1, section 3.4.1), by its definition: each pixel's diamond is
// intersected with the segment.
//
// R_f = {|x - xf| + |y - yf| < 1/2} is four open half planes. The segment's ends are p - (e, e^2); "e is chosen to be
// so small" that any smaller one gives the same fragments: e stays a symbol, and numbers are polynomials c0 + c1 e + c2
// e^2 compared by their first coefficient that differs. So no end is ever on a border, and, unmoved, a diamond owns of
// its border what the move brings inside: the points with x > xf, that is the right corner and the open right sides;
// not the top and bottom corners (|-e| grows), not the left side.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline::exact {

/// Whether the segment from `a` to `b` produces the pixel: it meets its diamond, and does not end in it. Coordinates in
/// 1/256 pixel, pixel (i, j)'s centre at (256 i, 256 j), within +-2^40.
bool produces(glm::i64vec2 a, glm::i64vec2 b, glm::i64vec2 pixel);

/// Those of a line `w` pixels wide (section 3.4.2): the segment is moved by -(w - 1)/2 along its minor axis, and each
/// fragment becomes w of them, upwards from it (of a y-major line, rightwards).
std::vector<glm::ivec2> wide_line_pixels(glm::i64vec2 a, glm::i64vec2 b, int w, int width, int height);

/// All pixels within `width` x `height` that the segment produces, by y, then x. Coordinates within +-2^40.
std::vector<glm::ivec2> line_pixels(glm::i64vec2 a, glm::i64vec2 b, int width, int height);

}  // namespace plumbline::exact

// Input and output of the triangle algorithms: corners and spans of pixels.
#pragma once

#include <array>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline::raster {

/// A triangle's corners in 1/256 pixel; pixel (i, j)'s centre is (256 i, 256 j).
using Corners = std::array<glm::ivec2, 3>;

/// The pixels [begin, end) of row y.
struct Span {
  int y, begin, end;
  bool operator==(const Span&) const = default;
};
using Spans = std::vector<Span>;

/// Appends a pixel: lengthens the last span if the pixel is the next in the span's row, else begins a span.
void append_pixel(int x, int y, Spans& out);

/// Throws std::out_of_range unless corners are within +-2^29 and sides within [1, 16384]. Then a difference of corners
/// is at most 2^30, its product with a coordinate at most 2^59, with another difference 2^60, and the sum of two such
/// products far below 2^63.
void require_in_range(const Corners& corners, int width, int height);

}  // namespace plumbline::raster

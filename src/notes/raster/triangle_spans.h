// What the triangle algorithms take and hand out.
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

/// Adds a pixel, which lengthens the last span if it is the next in its row.
void append_pixel(int x, int y, Spans& out);

/// Throws std::out_of_range unless corners are within +-2^29 and sides within [1, 16384]. Then differences of corners
/// are at most 2^30, products of one with a coordinate 2^59 or with another one 2^60, and their sums of two far below
/// 2^63.
void require_in_range(const Corners& corners, int width, int height);

}  // namespace plumbline::raster

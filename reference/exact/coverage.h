// Stage 5 in integers: the pixels whose centres a snapped primitive covers.
//
// E(p) = cross(b - a, p - a), times the sign of the area, is positive on the inner side of the edge a -> b. The tie
// rule left_bottom moves a sample by an infinitesimal (+e, +e^2): where E is 0, dE/dx decides, and where dE/dx is 0,
// dE/dy. Of two triangles on either side of an edge exactly one has a sample on the edge.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "capture/capture.h"
#include "reference/exact/wide.h"
#include "scene/scene.h"

namespace plumbline::exact {

/// Tie rule left_bottom: true if a sample on an edge is inside. Input: E's inward gradient.
bool tie_is_in(std::int64_t de_dx, std::int64_t de_dy);

/// Pixels [begin, end) of a row.
struct Span {
  int begin, end;
};

/// Pixels of a frame that a triangle of snapped corners covers, a span per row.
class CoveredRows {
 public:
  /// Pixels of a width x height frame, sampled at centres. Corners of either winding; no rows where the area is zero.
  CoveredRows(const std::array<glm::ivec2, 3>& snapped, int width, int height);
  /// Pixels of the frame within the draw's scissor box, sampled at the frame's sample offset.
  CoveredRows(const std::array<glm::ivec2, 3>& snapped, const FrameFormat& frame, const Draw& draw);
  int y_begin() const { return y_begin_; }
  int y_end() const { return y_end_; }
  Span row(int y) const;

 private:
  struct Edge {
    std::int64_t de_dx, de_dy;  // per subpixel
    Int128 at_origin;           // E at pixel (0, 0), less 1 where ties are out: in is >= 0
  };
  std::array<Edge, 3> edges_;
  int x_begin_ = 0, x_end_;
  int y_begin_ = 0, y_end_ = 0;
};

/// The number of pixels covered.
std::size_t covered_count(const CoveredRows& rows);

/// Appends one entry per pixel covered, by y, then x.
void append_covered(const CoveredRows& rows, std::uint32_t triangle, std::vector<Covered>& out);

/// Appends the pixels of a triangle, a line (line_coverage.h) or a point within the draw's scissor box, under record
/// number `triangle`. A triangle whose recorded facing contradicts its corners covers none. A point at the snapped
/// window position (x, y) covers the pixels with centres in a square of its size about (floor x + 1/2, floor y + 1/2),
/// or, for even sizes, about (floor(x + 1/2), floor(y + 1/2)) (OpenGL 2.1, section 3.3).
void append_covered(const WindowTriangle<double>& primitive, const FrameFormat& frame, const Draw& draw,
                    std::uint32_t triangle, std::vector<Covered>& out);

/// Stage 5, from the triangles' snapped corners and facings: records.covered, planes.count and planes.id_sum into
/// `out`. Throws OverBudget where they would take more than `budget` bytes.
void cover_triangles(const Scene& scene, const std::vector<WindowTriangle<double>>& triangles, std::size_t budget,
                     Capture& out);

/// Adds a fragment to the planes count and id_sum.
inline void add_fragment(Planes& planes, int x, int y, std::uint64_t weight) {
  planes.count(x, y) += 1;
  planes.id_sum(x, y) += weight;
}

}  // namespace plumbline::exact

// Edges that two triangles share: a sample on such an edge is in exactly one of the two.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "capture/stages.h"

namespace plumbline::check {

/// Corners in the window [pixels], as they are or as they are snapped.
std::array<glm::dvec2, 3> window_corners(const WindowTriangle<double>& t, bool snapped);

class SharedEdges {
 public:
  /// Edges between the corners as they are, or as they are snapped.
  SharedEdges(std::span<const WindowTriangle<double>> triangles, bool snapped);

  /// The triangle [index] beyond the edge of triangle `t` that `p_win` lies on, by exact arithmetic, between its ends.
  /// None if p_win lies on no edge, or unless exactly one triangle has an edge of the same ends and lies on the other
  /// side of it. OpenGL 2.1, section 3.5.1: a sample on such an edge is in exactly one of the two.
  std::optional<std::uint32_t> beyond(std::uint32_t t, glm::dvec2 p_win) const;

 private:
  struct Edge {
    glm::dvec2 low, high;  // ends [pixels], ordered by x, then by y
    std::uint32_t triangle;
    bool is_left;  // the triangle lies to the left of low -> high
  };
  std::optional<Edge> edge_of(std::uint32_t t, std::size_t side) const;

  std::span<const WindowTriangle<double>> triangles_;
  bool snapped_;
  std::vector<Edge> edges_;  // ordered by their ends
};

}  // namespace plumbline::check

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

/// Corners in the window [pixels], unsnapped or snapped.
std::array<glm::dvec2, 3> window_corners(const WindowTriangle<double>& t, bool snapped);

class SharedEdges {
 public:
  /// Edges between the unsnapped or the snapped corners.
  SharedEdges(std::span<const WindowTriangle<double>> triangles, bool snapped);

  /// Neighbour [index] across the edge of triangle `t` that p_win lies on, between the edge's ends, by exact
  /// arithmetic; none: on no edge, or on one not shared by exactly two triangles. A sample there is in exactly one of
  /// the two (OpenGL 2.1, 3.5.1).
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

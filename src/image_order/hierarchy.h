// Bounding volume hierarchy of boxes, so that a ray is not tried with every triangle.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "image_order/rays.h"

namespace plumbline::image_order {

/// Binary tree of axis-aligned boxes over triangles in world space. Keeps their indices, not the triangles.
class Hierarchy {
 public:
  explicit Hierarchy(const std::vector<std::array<glm::dvec3, 3>>& triangles);

  /// Calls visit(index) for every triangle that the ray may cross, and some more, nearer boxes mostly first. Left out
  /// are boxes whose farthest point is nearer along the view than `nearest`, and boxes for whose nearest point
  /// too_far(along) is true when their turn comes; what is too far must stay so for every greater `along`.
  template <class TooFar, class Visit>
  void walk(const Ray& ray, double nearest, TooFar too_far, Visit visit) const;

 private:
  struct Node {
    glm::dvec3 low, high;
    std::uint32_t first;  ///< leaf: index of order_; inner node: index of the first of two consecutive children
    std::uint32_t count;  ///< triangles of a leaf; 0: inner node
  };
  void split(std::uint32_t node, const std::vector<std::array<glm::dvec3, 3>>& triangles);

  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

/// Least and greatest n . p over the points p of the box [low, high]; for a ray, the box less the ray's origin.
struct Range {
  double low, high;
};
inline Range range(const glm::dvec3& n, const glm::dvec3& low, const glm::dvec3& high) {
  const glm::dvec3 a = n * low, b = n * high;
  const glm::dvec3 least = glm::min(a, b), most = glm::max(a, b);
  return {(least.x + least.y) + least.z, (most.x + most.y) + most.z};  // in the order of along()
}

template <class TooFar, class Visit>
void Hierarchy::walk(const Ray& ray, double nearest, TooFar too_far, Visit visit) const {
  struct Entry {
    double near;
    std::uint32_t node;
  };
  std::array<Entry, 64> waiting;  // one sibling per level, and one more; halving makes at most 31 levels
  std::size_t count = 0;
  const auto consider = [&](std::uint32_t node) {
    const glm::dvec3 low = nodes_[node].low - ray.origin, high = nodes_[node].high - ray.origin;
    const Range x = range(ray.column, low, high), y = range(ray.row, low, high), z = range(ray.forward, low, high);
    if (x.low > 0 || x.high < 0 || y.low > 0 || y.high < 0 || z.high < nearest) return;
    waiting[count++] = {z.low, node};
  };
  if (!nodes_.empty()) consider(0);
  while (count > 0) {
    const Entry entry = waiting[--count];
    if (too_far(entry.near)) continue;
    const Node& node = nodes_[entry.node];
    for (std::uint32_t i = 0; i < node.count; ++i) visit(order_[node.first + i]);
    if (node.count > 0) continue;
    const std::size_t before = count;
    consider(node.first);
    consider(node.first + 1);
    if (count == before + 2 && waiting[before].near < waiting[before + 1].near) {
      std::swap(waiting[before], waiting[before + 1]);  // the nearer one first
    }
  }
}

}  // namespace plumbline::image_order

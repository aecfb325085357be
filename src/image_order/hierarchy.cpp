#include "image_order/hierarchy.h"

#include <algorithm>
#include <numeric>

namespace plumbline::image_order {

namespace {

constexpr std::uint32_t kLeaf = 4;

}  // namespace

Hierarchy::Hierarchy(const std::vector<std::array<glm::dvec3, 3>>& triangles) : order_(triangles.size()) {
  if (triangles.empty()) return;
  std::iota(order_.begin(), order_.end(), 0u);
  nodes_.reserve(triangles.size());
  nodes_.push_back({{}, {}, 0, static_cast<std::uint32_t>(triangles.size())});
  split(0, triangles);
}

// Splits a node with more than kLeaf triangles at the median of their centroids along the box's longest side.
void Hierarchy::split(std::uint32_t index, const std::vector<std::array<glm::dvec3, 3>>& triangles) {
  const std::uint32_t first = nodes_[index].first, count = nodes_[index].count;
  glm::dvec3 low = triangles[order_[first]][0], high = low;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const glm::dvec3& p : triangles[order_[first + i]]) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  nodes_[index].low = low;
  nodes_[index].high = high;
  if (count <= kLeaf) return;

  const glm::dvec3 size = high - low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto middle_of = [&](std::uint32_t i) {
    return triangles[i][0][axis] + triangles[i][1][axis] + triangles[i][2][axis];
  };
  const auto from = order_.begin() + first;
  std::nth_element(from, from + count / 2, from + count, [&](std::uint32_t a, std::uint32_t b) {
    const double a_middle = middle_of(a), b_middle = middle_of(b);
    return a_middle != b_middle ? a_middle < b_middle : a < b;  // one order on every machine
  });
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_[index].first = child;
  nodes_[index].count = 0;
  nodes_.push_back({{}, {}, first, count / 2});
  nodes_.push_back({{}, {}, first + count / 2, count - count / 2});
  split(child, triangles);
  split(child + 1, triangles);
}

}  // namespace plumbline::image_order

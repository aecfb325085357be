#include "scene/json/scene_values.h"

#include <fmt/format.h>

namespace plumbline {

glm::dvec3 read_point(const JsonNode& node) { return node.vector<3>(-kLargestCoordinate, kLargestCoordinate); }

glm::dvec3 read_direction(const JsonNode& node) {
  const glm::dvec3 v = read_point(node);
  if (glm::length(v) < kSmallestLength) {
    node.refuse("a direction that is not zero", fmt::format("[{}, {}, {}]", v.x, v.y, v.z));
  }
  return v;
}

}  // namespace plumbline

// Values that occur all over a scene file, and their limits.
#pragma once

#include <cstddef>

#include <glm/glm.hpp>

#include "scene/json/json_tree.h"

namespace plumbline {

/// The largest coordinate that a scene may hold: the products of three such numbers stay far within float's range.
inline constexpr double kLargestCoordinate = 1e6;
/// The shortest vector and the smallest scale: their reciprocals are harmless in float.
inline constexpr double kSmallestLength = 1e-6;
/// A primitive's number is exact in float.
inline constexpr std::size_t kMostTriangles = 1u << 24;

/// Both throw JsonError.
glm::dvec3 read_point(const JsonNode& node);
glm::dvec3 read_direction(const JsonNode& node);  ///< not zero

}  // namespace plumbline

// Points and directions of scene files, and the limits of a scene's numbers.
#pragma once

#include <cstddef>

#include <glm/glm.hpp>

#include "scene/json/json_tree.h"

namespace plumbline {

/// Largest absolute value of a coordinate: products of three coordinates stay far within float's range.
inline constexpr double kLargestCoordinate = 1e6;
/// Least length of a vector, and least scale: their reciprocals are harmless in float.
inline constexpr double kSmallestLength = 1e-6;
/// Most primitives of a scene, so that a primitive's number is exact in float.
inline constexpr std::size_t kMostPrimitives = 1u << 24;

/// Three numbers within +-kLargestCoordinate. Throws JsonError.
glm::dvec3 read_point(const JsonNode& node);
/// A point at least kSmallestLength from the origin. Throws JsonError.
glm::dvec3 read_direction(const JsonNode& node);

}  // namespace plumbline

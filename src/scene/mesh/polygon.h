// Check of polygons before they are cut into triangles: every cut of a valid polygon looks the same.
#pragma once

#include <span>
#include <string>

#include <glm/glm.hpp>

namespace plumbline {

/// Fault of a polygon, in the words that follow "found" in a message; empty: the polygon is valid. A valid polygon is
/// flat (each corner within 1/128 of the bounding box' diagonal from the plane), has an area, and does not cross or
/// touch itself. Three corners or fewer are always valid. Corners must be finite.
std::string polygon_fault(std::span<const glm::dvec3> corners);

}  // namespace plumbline

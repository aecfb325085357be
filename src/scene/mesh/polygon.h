// Check of polygons that are to be cut into triangles: whichever way a valid polygon is cut, the surface looks the
// same.
#pragma once

#include <span>
#include <string>

#include <glm/glm.hpp>

namespace plumbline {

/// Description of what is wrong with a polygon, as it follows "found" in a message; empty: the polygon is valid. It
/// must be flat (each corner within 1/128 of the diagonal of its bounding box from its plane), have an area, and not
/// cross or touch itself. Three corners or fewer are always valid. Corners must be finite.
std::string polygon_fault(std::span<const glm::dvec3> corners);

}  // namespace plumbline

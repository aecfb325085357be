// Convex and concave polygons as triangles (note 001, "break up other polygons"; note 004, section 2.3, "can be
// decomposed into triangles"), by clipping ears (Meisters, "Polygons have ears", 1975).
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline::raster {

/// Cuts a polygon of n corners into n - 2 triangles (indices of corners), of the polygon's winding, that cover the
/// polygon exactly once. An ear is three successive corners whose triangle has an area and holds no other corner, not
/// even on its border: corners within a straight side remain corners, and every triangle has an area. Exact, in
/// integers. The first ear is cut each time: the result is the same on every machine. O(n^3) at worst.
/// Corners in 1/256 pixel or any other unit, within +-2^29. Throws std::invalid_argument for fewer than three corners,
/// corners out of range, and a polygon that crosses or touches itself or has no area. (scene/mesh/polygon.h decides
/// which polygons a mesh file may have.)
std::vector<glm::uvec3> decompose(std::span<const glm::ivec2> corners);

}  // namespace plumbline::raster

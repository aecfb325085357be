// Convex and concave polygons as triangles (note 001, "break up other polygons"; note 004, section 2.3, "can be
// decomposed into triangles"), by clipping ears (Meisters, "Polygons have ears", 1975).
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace plumbline::raster {

/// Cuts a polygon of n corners into n - 2 triangles of its corners' indices, wound as it is: together they cover it
/// once. An ear is three corners in a row whose triangle has an area and holds no other corner, not even on its border,
/// so that corners amid a straight side stay corners of the pieces, and no piece is without area. In integers, exact,
/// in O(n^3) at worst, of the first ear each time: the same on every machine. Corners in 1/256 pixel or any other unit,
/// within +-2^29. Throws std::invalid_argument for fewer than three, corners beyond that, and a polygon that crosses or
/// touches itself or has no area. (What may stand in a mesh file is decided in scene/mesh/polygon.h.)
std::vector<glm::uvec3> decompose(std::span<const glm::ivec2> corners);

}  // namespace plumbline::raster

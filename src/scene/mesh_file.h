// Meshes from files.
#pragma once

#include <filesystem>
#include <stdexcept>

#include "scene/scene.h"

namespace plumbline {

/// The message names the file, what was expected and what was found.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The largest coordinate that a scene may hold: the products of three such numbers stay far within float's range.
inline constexpr double kLargestCoordinate = 1e6;

/// An OBJ or 3DS file as one mesh in the file's world space: placed parts are moved there and put together, polygons
/// cut into triangles, equal vertices joined; lines, points and triangles of fewer than three vertices are left out.
/// The winding stays as it is in the file (a mirroring placement turns it, so that what was outside stays outside).
/// A normal that is missing, zero or not finite is made from the adjacent triangles. 3DS files are taken to be z-up and
/// turned to y-up: (x, y, z) becomes (x, z, -y).
/// Throws MeshError: not readable, not one of the two formats, no triangles, a position not finite or beyond
/// kLargestCoordinate, an index out of range.
Mesh load_mesh(const std::filesystem::path& file);

}  // namespace plumbline

// Meshes made by formula: the same numbers on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline {

/// One normal per position: the sum of the adjacent triangles' normals, each as long as its area, at unit length;
/// +z where that sum is zero or not finite. Every index must be in range.
std::vector<glm::vec3> area_weighted_normals(std::span<const glm::vec3> positions,
                                             std::span<const glm::uvec3> triangles);

/// A mesh of given corners, with area-weighted normals. `colors` is empty or as long as `positions`.
Mesh make_triangles(std::vector<glm::vec3> positions, std::vector<glm::uvec3> triangles, std::vector<glm::vec4> colors);

/// The square [-1,1]^2 in z = 0, normal +z, counter-clockwise seen from +z, texture coordinates from (0,0) to (1,1).
/// columns, rows >= 1.
Mesh make_grid(int columns, int rows);

/// The unit sphere, poles at y = +-1, counter-clockwise from outside; a normal is its position. Each vertex exists
/// once, so the mesh is closed, and each pole is the tip of `slices` triangles. slices >= 3, stacks >= 2.
Mesh make_uv_sphere(int slices, int stacks);

/// The same sphere cut open along the meridian of +z, with texture coordinates: s from 0 to 1 eastwards, t from the
/// south pole's 0 to the north pole's 1. At a pole each triangle has its own vertex, s in the triangle's middle.
Mesh make_globe(int slices, int stacks);

/// `triangles` separate triangles: the middle anywhere in [-extent,extent]^3, each corner up to `size` from it along
/// each axis, each corner of another colour (alpha 1), the normal the triangle's own.
Mesh make_soup(int triangles, std::uint64_t seed, double extent, double size);

}  // namespace plumbline

// Meshes made by formula: the same numbers on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace plumbline {

/// Unit normals, one per position: the sum of the adjacent triangles' normals, weighted by area, normalised; +z where
/// that sum is zero or not finite. Every index must be in range.
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

/// make_uv_sphere()'s sphere cut open along the meridian of +z, with texture coordinates: s from 0 to 1 eastwards, t
/// from 0 at the south pole to 1 at the north pole. At a pole each triangle has its own vertex, with the s of the
/// triangle's middle; one further vertex per pole, with s above 1, belongs to no triangle. slices >= 3, stacks >= 2.
Mesh make_globe(int slices, int stacks);

/// `triangles` random triangles that share no vertex: centre in [-extent,extent]^3, corners within `size` of it along
/// each axis, a random colour per corner (alpha 1), the triangle's own normal.
Mesh make_soup(int triangles, std::uint64_t seed, double extent, double size);

}  // namespace plumbline

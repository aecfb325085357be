// Stages 3 and 4 of triangles whose vertices have been through them already: assembled, culled, and put into bins.
#pragma once

#include "painter/painting.h"

namespace plumbline::pipeline {

/// Per-draw input of triangle assembly.
struct AssemblyWork {
  const Draw* draw;
  const Mesh* mesh;
  DrawRange range;
  std::uint8_t planes;          ///< outcode bits of the planes that cut (clip.h)
  const std::uint8_t* outside;  ///< null: its window triangles are all in `others`
  std::uint8_t any_outside;     ///< OR of `outside[]` over the draw's vertices
};

/// Drawn face of a triangle.
enum class Kept : std::int32_t { none, back, front };
struct KeptTriangle {
  Kept kept;
  TileBox box;
};
/// One for each of `corners`, numbers of the mesh's vertices, of a draw of filled triangles. Triangles with a corner outside the view volume get any
/// (cull_lanes.h).
using CullTriangles = void (*)(const Painting& painting, const AssemblyWork& draw, std::span<const glm::uvec3> corners,
                               KeptTriangle* to);

/// Window triangles that came another way (scalar_geometry.h), by primitive: clipped ones, lines, points.
struct OtherTriangles {
  std::span<const ShadedTriangle> triangles;
  std::uint32_t first_vertex;  ///< their corners' numbers from there on, three each
};

/// The chunk's triangles, and which tiles they touch.
void assemble(Chunk& chunk, std::span<const AssemblyWork> draws, const OtherTriangles& others, const Painting& painting,
              CullTriangles cull);

}  // namespace plumbline::pipeline

// Stages 3 and 4 of triangles whose vertices have been through them already: assembled, culled, and put into bins.
#pragma once

#include "pipeline/painting.h"

namespace plumbline::pipeline {

/// What of a draw its triangles are assembled from.
struct AssemblyWork {
  const Draw* draw;
  const Mesh* mesh;
  DrawRange range;
  std::uint8_t planes;  ///< bits of those that cut (clip.h)
  std::uint32_t first_vertex;
  const std::uint8_t* outside;  ///< null: its window triangles are all in `others`
};

/// Window triangles that came another way (draw.h), by primitive: clipped ones, lines, points.
struct OtherTriangles {
  std::span<const WindowTriangle<float>> triangles;
  std::uint32_t first_vertex;  ///< their corners' numbers from there on, three each
};

/// The chunk's triangles, and which tiles they touch. `others`: per draw.
void assemble(Chunk& chunk, std::span<const AssemblyWork> draws, std::span<const OtherTriangles> others,
              const Painting& painting);

}  // namespace plumbline::pipeline

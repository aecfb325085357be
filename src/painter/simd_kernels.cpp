// Compiled once for each target (src/CMakeLists.txt).
#include "painter/simd_targets.h"

#include "kernels/simd_fours.h"

#include "painter/cull_lanes.h"
#include "painter/paint_tile.h"
#include "painter/paint_vertices.h"

#define PLUMBLINE_JOIN(a, b) a##b
#define PLUMBLINE_NAME(a, b) PLUMBLINE_JOIN(a, b)

namespace plumbline::pipeline {

std::uint8_t PLUMBLINE_NAME(paint_vertices_, PLUMBLINE_TARGET)(const VertexWork& work, std::size_t from,
                                                               std::size_t to) {
  return paint_vertices<PLUMBLINE_TARGET::Simd>(work, from, to);
}

void PLUMBLINE_NAME(cull_triangles_, PLUMBLINE_TARGET)(const CullWork& work, std::span<const glm::uvec3> corners,
                                                       KeptTriangle* to) {
  cull_triangles<PLUMBLINE_TARGET::Simd>(work, corners, to);
}

void PLUMBLINE_NAME(paint_tile_, PLUMBLINE_TARGET)(const Painting& painting, int number, TileMemory& memory,
                                                   Frame& frame) {
  paint_tile<PLUMBLINE_TARGET::Simd>(painting, number, memory, frame);
}

}  // namespace plumbline::pipeline

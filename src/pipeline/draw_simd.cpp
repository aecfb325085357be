// Compiled once for each target (src/CMakeLists.txt).
#include "pipeline/draw_simd.h"

#include "pipeline/simd_coverage.h"
#include "pipeline/simd_fours.h"

#include "pipeline/paint_tile.h"
#include "pipeline/paint_vertices.h"

#define PLUMBLINE_JOIN(a, b) a##b
#define PLUMBLINE_NAME(a, b) PLUMBLINE_JOIN(a, b)

namespace plumbline::pipeline {

void PLUMBLINE_NAME(paint_vertices_, PLUMBLINE_TARGET)(const VertexWork& work, std::size_t from, std::size_t to) {
  paint_vertices<PLUMBLINE_TARGET::Simd>(work, from, to);
}

void PLUMBLINE_NAME(paint_tile_, PLUMBLINE_TARGET)(const Painting& painting, int number, TileMemory& memory,
                                                   Frame& frame) {
  paint_tile<PLUMBLINE_TARGET::Simd>(painting, number, memory, frame);
}

}  // namespace plumbline::pipeline

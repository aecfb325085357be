// Compiled once for each target (src/CMakeLists.txt).
#include "pipeline/draw_simd.h"

#include "pipeline/simd_coverage.h"
#include "pipeline/simd_surface.h"

#define PLUMBLINE_JOIN(a, b) a##b
#define PLUMBLINE_NAME(a, b) PLUMBLINE_JOIN(a, b)

namespace plumbline::pipeline {

void PLUMBLINE_NAME(draw_tile_, PLUMBLINE_TARGET)(const TileList& work, std::size_t number_of_tile, Tile& tile) {
  NoTap tap;
  draw_tile<PLUMBLINE_TARGET::Simd>(FragmentStages(), work, number_of_tile, tile, tap);
}

}  // namespace plumbline::pipeline

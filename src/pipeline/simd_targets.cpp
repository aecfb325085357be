#include <array>

#include "pipeline/draw_simd.h"
#include "pipeline/paint_tile.h"
#include "pipeline/paint_vertices.h"

namespace plumbline::pipeline {

void paint_vertices_sse4(const VertexWork& work, std::size_t from, std::size_t to);
void paint_vertices_avx2(const VertexWork& work, std::size_t from, std::size_t to);
void paint_vertices_avx512(const VertexWork& work, std::size_t from, std::size_t to);
void paint_tile_sse4(const Painting& painting, int number, TileMemory& memory, Frame& frame);
void paint_tile_avx2(const Painting& painting, int number, TileMemory& memory, Frame& frame);
void paint_tile_avx512(const Painting& painting, int number, TileMemory& memory, Frame& frame);

std::span<const SimdTarget> simd_targets() {
  static constexpr std::array<SimdTarget, 4> kTargets = {{{"float", paint_vertices<float>, paint_tile<float>},
                                                          {"sse4", paint_vertices_sse4, paint_tile_sse4},
                                                          {"avx2", paint_vertices_avx2, paint_tile_avx2},
                                                          {"avx512", paint_vertices_avx512, paint_tile_avx512}}};
  __builtin_cpu_init();
  const bool has_sse4 = __builtin_cpu_supports("sse4.2") != 0;
  const bool has_avx2 = has_sse4 && __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                        __builtin_cpu_supports("bmi2") != 0;
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") != 0 &&
                          __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                          __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  return std::span(kTargets).first(has_avx512 ? 4 : has_avx2 ? 3 : has_sse4 ? 2 : 1);
}

}  // namespace plumbline::pipeline

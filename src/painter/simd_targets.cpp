#include <array>

#include "painter/cull_lanes.h"
#include "painter/paint_tile.h"
#include "painter/paint_vertices.h"
#include "painter/simd_targets.h"

namespace plumbline::pipeline {

#define PLUMBLINE_KERNELS(target)                                                                            \
  std::uint8_t paint_vertices_##target(const VertexWork& work, std::size_t from, std::size_t to);            \
  void cull_triangles_##target(const CullWork& work, std::span<const glm::uvec3> corners, KeptTriangle* to); \
  void paint_tile_##target(const Painting& painting, int number, TileMemory& memory, Frame& frame);
PLUMBLINE_KERNELS(sse4)
PLUMBLINE_KERNELS(avx2)
PLUMBLINE_KERNELS(avx512)

std::span<const SimdTarget> simd_targets() {
  static constexpr std::array<SimdTarget, 4> kTargets = {
      {{"float", paint_vertices<float>, cull_triangles<float>, paint_tile<float>},
       {"sse4", paint_vertices_sse4, cull_triangles_sse4, paint_tile_sse4},
       {"avx2", paint_vertices_avx2, cull_triangles_avx2, paint_tile_avx2},
       {"avx512", paint_vertices_avx512, cull_triangles_avx512, paint_tile_avx512}}};
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

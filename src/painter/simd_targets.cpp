#include <cpuid.h>

#include <array>

#include "painter/cull_lanes.h"
#include "painter/paint_tile.h"
#include "painter/paint_vertices.h"
#include "painter/painter.h"

namespace plumbline::pipeline {

extern constinit const SimdTarget kSimd_sse4, kSimd_avx2, kSimd_avx512;  // simd_kernels.cpp

namespace {

// F16C by cpuid: clang 14's __builtin_cpu_supports() does not know it.
bool has_f16c() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  return __get_cpuid(1, &a, &b, &c, &d) != 0 && (c & bit_F16C) != 0;
}

}  // namespace

// Targets whose instruction sets (plumbline_simd() in CMakeLists.txt) the processor has, every one of them: a virtual
// machine may hide some.
std::span<const SimdTarget> simd_targets() {
  static const std::array<SimdTarget, 4> kTargets = {
      {{"float", paint_vertices<float>, cull_triangles<float>, paint_tiles<float>},
       kSimd_sse4,
       kSimd_avx2,
       kSimd_avx512}};
  __builtin_cpu_init();
  const bool has_sse4 = __builtin_cpu_supports("sse4.2") != 0;
  const bool has_avx2 = has_sse4 && __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                        __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0 &&
                        __builtin_cpu_supports("pclmul") != 0 && __builtin_cpu_supports("aes") != 0 && has_f16c();
  const bool has_avx512 = has_avx2 && __builtin_cpu_supports("avx512f") != 0 &&
                          __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                          __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
  return std::span(kTargets).first(has_avx512 ? 4 : has_avx2 ? 3 : has_sse4 ? 2 : 1);
}

}  // namespace plumbline::pipeline

#include <array>

#include "pipeline/draw_simd.h"

namespace plumbline::pipeline {

namespace {

void draw_tile_float(const TileList& work, std::size_t number_of_tile, Tile& tile) {
  NoTap tap;
  draw_tile<float>(FragmentStages(), work, number_of_tile, tile, tap);
}

}  // namespace

void draw_tile_sse4(const TileList& work, std::size_t number_of_tile, Tile& tile);
void draw_tile_avx2(const TileList& work, std::size_t number_of_tile, Tile& tile);

std::span<const SimdTarget> simd_targets() {
  static constexpr std::array<SimdTarget, 3> kTargets = {
      {{"float", draw_tile_float}, {"sse4", draw_tile_sse4}, {"avx2", draw_tile_avx2}}};
  __builtin_cpu_init();
  const bool has_sse4 = __builtin_cpu_supports("sse4.2") != 0;
  const bool has_avx2 = has_sse4 && __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                        __builtin_cpu_supports("bmi2") != 0;
  return std::span(kTargets).first(has_avx2 ? 3 : has_sse4 ? 2 : 1);
}

void draw_frame(DrawTile draw_tile, const DrawList& list, const FrameFormat& format, Frame& frame) {
  const TileList work = tile_list(list, format);
  each_tile(work, frame, [&](std::size_t number, Tile& tile) { draw_tile(work, number, tile); });
}

}  // namespace plumbline::pipeline

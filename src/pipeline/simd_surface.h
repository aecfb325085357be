// Where a kernel reads memory each lane at its own place.
#pragma once

#include "pipeline/simd.h"
#include "pipeline/texture.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {
namespace {

inline Color<Simd> texels(const glm::vec4* from, SimdInt number) {
  HWY_ALIGN std::int32_t numbers[kWidth];
  hn::Store(number.v, kInts, numbers);
  const float* of_lane[kWidth];
  for (int lane = 0; lane < kWidth; ++lane) of_lane[lane] = &from[numbers[lane]].r;
  Simd texel[4];
  load_fours(of_lane, texel);
  return {texel[0], texel[1], texel[2], texel[3]};
}

}  // namespace
}  // namespace PLUMBLINE_TARGET
}  // namespace plumbline::pipeline

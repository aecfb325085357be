// Where a kernel reads memory each lane at its own place.
#pragma once

#include "pipeline/simd.h"
#include "pipeline/texture.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {
namespace {

inline Color<Simd> texels(const glm::vec4* from, SimdInt number) {
  HWY_ALIGN std::int32_t eights[kWidth];  // of bytes, by which an address is scaled for nothing
  hn::Store(hn::ShiftLeft<1>(number.v), kInts, eights);
  const auto* bytes = reinterpret_cast<const char*>(from);
  const float* of_lane[kWidth];
  for (int lane = 0; lane < kWidth; ++lane) {
    of_lane[lane] = reinterpret_cast<const float*>(bytes + 8 * std::ptrdiff_t{eights[lane]});
  }
  Simd texel[4];
  load_fours(of_lane, texel);
  return {texel[0], texel[1], texel[2], texel[3]};
}

}  // namespace
}  // namespace PLUMBLINE_TARGET
}  // namespace plumbline::pipeline

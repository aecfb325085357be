// Stage 5 of triangles that do not fit 32 bits (set_up_lanes.h), for SIMD targets: pixel by pixel in 64 bits.
#pragma once

#include "kernels/coverage.h"
#include "kernels/simd.h"

namespace plumbline::pipeline {

template <>
inline PLUMBLINE_TARGET::SimdMask coverage<PLUMBLINE_TARGET::Simd>(const Edges& edges,
                                                                   const Pixels<PLUMBLINE_TARGET::Simd>& p) {
  using namespace PLUMBLINE_TARGET;
  HWY_ALIGN std::int32_t x[kWidth], y[kWidth], covered[kWidth];
  hn::Store(p.x.v, kInts, x);
  hn::Store(p.y.v, kInts, y);
  for (int i = 0; i < kWidth; ++i) {
    covered[i] = pipeline::coverage<float>(edges, {x[i], y[i], 0.0, 0.0}) ? 1 : 0;
  }
  return SimdInt(hn::Load(kInts, covered)) > SimdInt(0);
}

}  // namespace plumbline::pipeline

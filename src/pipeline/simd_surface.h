// Where a kernel reads memory each lane at its own place.
#pragma once

#include "pipeline/simd.h"
#include "pipeline/texture.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {

/// Of each four lanes, a texel of each; then transposed.
inline Color<Simd> texels(const glm::vec4* from, SimdInt number) {
  HWY_ALIGN std::int32_t numbers[kWidth];
  hn::Store(number.v, kInts, numbers);
  const auto four = [&](int lane) { return hn::LoadU(hn::FixedTag<float, 4>(), &from[numbers[lane]].x); };
  const auto row = [&](auto i) {
    if constexpr (kWidth == 4)
      return four(i);
    else
      return hn::Combine(kFloats, four(i + 4), four(i));
  };
  static_assert(kWidth <= 8);
  const FloatVector a = row(0), b = row(1), c = row(2), d = row(3);
  const auto pair = [](FloatVector v) { return hn::BitCast(kDoubles, v); };
  const auto rg = [&](FloatVector x, FloatVector y) { return pair(hn::InterleaveLower(kFloats, x, y)); };
  const auto ba = [&](FloatVector x, FloatVector y) { return pair(hn::InterleaveUpper(kFloats, x, y)); };
  const auto first = [](DoubleVector x, DoubleVector y) {
    return Simd(hn::BitCast(kFloats, hn::InterleaveLower(kDoubles, x, y)));
  };
  const auto second = [](DoubleVector x, DoubleVector y) {
    return Simd(hn::BitCast(kFloats, hn::InterleaveUpper(kDoubles, x, y)));
  };
  const DoubleVector rg_ab = rg(a, b), rg_cd = rg(c, d), ba_ab = ba(a, b), ba_cd = ba(c, d);
  return {first(rg_ab, rg_cd), second(rg_ab, rg_cd), first(ba_ab, ba_cd), second(ba_ab, ba_cd)};
}

}  // namespace PLUMBLINE_TARGET
}  // namespace plumbline::pipeline

// The words of lanes.h that take four floats of each lane, which lie side by side in memory.
#pragma once

#include "kernels/simd.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {
namespace {

inline void transpose_fours(const Simd (&in)[4], Simd (&out)[4]) {
  const auto wide = [](FloatVector v) { return hn::BitCast(kDoubles, v); };
  const auto low = hn::InterleaveLower(kFloats, in[0].v, in[1].v),
             high = hn::InterleaveUpper(kFloats, in[0].v, in[1].v);
  const auto low2 = hn::InterleaveLower(kFloats, in[2].v, in[3].v),
             high2 = hn::InterleaveUpper(kFloats, in[2].v, in[3].v);
  out[0] = hn::BitCast(kFloats, hn::InterleaveLower(kDoubles, wide(low), wide(low2)));
  out[1] = hn::BitCast(kFloats, hn::InterleaveUpper(kDoubles, wide(low), wide(low2)));
  out[2] = hn::BitCast(kFloats, hn::InterleaveLower(kDoubles, wide(high), wide(high2)));
  out[3] = hn::BitCast(kFloats, hn::InterleaveUpper(kDoubles, wide(high), wide(high2)));
}
[[gnu::always_inline]] inline void load_fours(const float* const (&from)[kWidth], Simd (&out)[4]) {
  Simd rows[4];
  for (int i = 0; i < 4; ++i) {
    rows[i] = of_blocks([&](int lane) { return hn::LoadU(kBlockFloats, from[lane + i]); });
  }
  transpose_fours(rows, out);
}
[[gnu::always_inline]] inline void store_fours(const Simd (&values)[4], float* const (&to)[kWidth]) {
  Simd rows[4];
  transpose_fours(values, rows);
  for (int i = 0; i < 4; ++i) {
    HWY_ALIGN float lanes[kWidth];
    hn::Store(rows[i].v, kFloats, lanes);
    for (int block = 0; block < kWidth; block += 4) {
      hn::StoreU(hn::Load(kBlockFloats, lanes + block), kBlockFloats, to[block + i]);
    }
  }
}
// Of fours: a vector of doubles holds those of one lane, or half of them, or those of two lanes.
inline constexpr hn::FixedTag<double, kHalf == 2 ? 2 : 4> kFourDoubles{};
inline constexpr hn::FixedTag<float, kHalf == 2 ? 2 : 4> kFourFloats{};
template <class Four>
[[gnu::always_inline]] inline SimdWide row_of(int row, Four four) {
  if constexpr (kHalf == 2) {
    return {four(row, 0), four(row, 2)};
  } else if constexpr (kHalf == 4) {
    return {four(row, 0), four(row + 4, 0)};
  } else {
    return {hn::Combine(kDoubles, four(row + 4, 0), four(row, 0)),
            hn::Combine(kDoubles, four(row + 12, 0), four(row + 8, 0))};
  }
}
[[gnu::always_inline]] inline SimdWide row_of_fours(Simd, int row, auto at) {
  return row_of(
      row, [&](int lane, int first) { return hn::PromoteTo(kFourDoubles, hn::LoadU(kFourFloats, at(lane) + first)); });
}
[[gnu::always_inline]] inline SimdWide row_of_shares(Simd, int row, const double (&k)[kWidth]) {
  return row_of(row, [&](int lane, int) { return hn::Set(kFourDoubles, k[lane]); });
}
[[gnu::always_inline]] inline void fours_of_rows(const SimdWide (&rows)[4], Simd (&out)[4]) {
  const Simd of[4] = {to_float(rows[0]), to_float(rows[1]), to_float(rows[2]), to_float(rows[3])};
  transpose_fours(of, out);
}

}  // namespace
}  // namespace PLUMBLINE_TARGET

}  // namespace plumbline::pipeline

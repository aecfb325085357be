// The words of lanes.h for as many pixels at a time as the target has lanes, over Highway: each lane does what float
// does, bit for bit. Included by draw_simd.cpp alone, which is compiled once for each target, PLUMBLINE_TARGET: a
// namespace of that name keeps their functions apart.
#pragma once

#include <hwy/highway.h>

#include "pipeline/lanes.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr int kWidth = HWY_MAX_BYTES / 4;  // 4, 8 or 16: a part of a block, or all of it
inline constexpr int kHalf = kWidth / 2;
inline constexpr hn::FixedTag<float, kWidth> kFloats{};
inline constexpr hn::FixedTag<float, kHalf> kHalfFloats{};
inline constexpr hn::FixedTag<std::int32_t, kWidth> kInts{};
inline constexpr hn::FixedTag<std::int32_t, kHalf> kHalfInts{};
inline constexpr hn::FixedTag<std::uint8_t, kWidth> kBytes{};
inline constexpr hn::FixedTag<double, kHalf> kDoubles{};
inline constexpr hn::FixedTag<std::uint64_t, kHalf> kLongs{};

using FloatVector = hn::Vec<decltype(kFloats)>;
using IntVector = hn::Vec<decltype(kInts)>;
using DoubleVector = hn::Vec<decltype(kDoubles)>;
using FloatMask = hn::Mask<decltype(kFloats)>;
using DoubleMask = hn::Mask<decltype(kDoubles)>;

struct SimdMask {
  FloatMask m;
  friend SimdMask operator&(SimdMask a, SimdMask b) { return {hn::And(a.m, b.m)}; }
  friend SimdMask operator|(SimdMask a, SimdMask b) { return {hn::Or(a.m, b.m)}; }
};
inline bool any(SimdMask mask) { return !hn::AllFalse(kFloats, mask.m); }

/// One float a lane.
struct Simd {
  FloatVector v;
  Simd() = default;
  Simd(FloatVector of) : v(of) {}
  Simd(float of) : v(hn::Set(kFloats, of)) {}
  friend Simd operator+(Simd a, Simd b) { return hn::Add(a.v, b.v); }
  friend Simd operator-(Simd a, Simd b) { return hn::Sub(a.v, b.v); }
  friend Simd operator*(Simd a, Simd b) { return hn::Mul(a.v, b.v); }
  friend Simd operator/(Simd a, Simd b) { return hn::Div(a.v, b.v); }
  friend Simd operator-(Simd a) { return hn::Neg(a.v); }
  friend SimdMask operator<(Simd a, Simd b) { return {hn::Lt(a.v, b.v)}; }
  friend SimdMask operator<=(Simd a, Simd b) { return {hn::Le(a.v, b.v)}; }
  friend SimdMask operator>(Simd a, Simd b) { return {hn::Gt(a.v, b.v)}; }
  friend SimdMask operator>=(Simd a, Simd b) { return {hn::Ge(a.v, b.v)}; }
  friend SimdMask operator==(Simd a, Simd b) { return {hn::Eq(a.v, b.v)}; }
  friend SimdMask operator!=(Simd a, Simd b) { return {hn::Ne(a.v, b.v)}; }
};

/// Of doubles, in two halves.
struct WideMask {
  DoubleMask low, high;
  friend WideMask operator&(WideMask a, WideMask b) { return {hn::And(a.low, b.low), hn::And(a.high, b.high)}; }
  friend WideMask operator|(WideMask a, WideMask b) { return {hn::Or(a.low, b.low), hn::Or(a.high, b.high)}; }
  operator SimdMask() const {
    const auto ones = [](DoubleMask m) {
      return hn::DemoteTo(kHalfFloats, hn::IfThenElseZero(m, hn::Set(kDoubles, 1.0)));
    };
    return {hn::Ne(hn::Combine(kFloats, ones(high), ones(low)), hn::Zero(kFloats))};
  }
};

struct SimdWide {
  DoubleVector low, high;
  SimdWide() = default;
  SimdWide(DoubleVector l, DoubleVector h) : low(l), high(h) {}
  SimdWide(double of) : low(hn::Set(kDoubles, of)), high(low) {}
  friend SimdWide operator+(SimdWide a, SimdWide b) { return {hn::Add(a.low, b.low), hn::Add(a.high, b.high)}; }
  friend SimdWide operator-(SimdWide a, SimdWide b) { return {hn::Sub(a.low, b.low), hn::Sub(a.high, b.high)}; }
  friend SimdWide operator*(SimdWide a, SimdWide b) { return {hn::Mul(a.low, b.low), hn::Mul(a.high, b.high)}; }
  friend SimdWide operator/(SimdWide a, SimdWide b) { return {hn::Div(a.low, b.low), hn::Div(a.high, b.high)}; }
  friend SimdWide operator-(SimdWide a) { return {hn::Neg(a.low), hn::Neg(a.high)}; }
  friend WideMask operator<(SimdWide a, SimdWide b) { return {hn::Lt(a.low, b.low), hn::Lt(a.high, b.high)}; }
  friend WideMask operator<=(SimdWide a, SimdWide b) { return {hn::Le(a.low, b.low), hn::Le(a.high, b.high)}; }
  friend WideMask operator>(SimdWide a, SimdWide b) { return {hn::Gt(a.low, b.low), hn::Gt(a.high, b.high)}; }
  friend WideMask operator>=(SimdWide a, SimdWide b) { return {hn::Ge(a.low, b.low), hn::Ge(a.high, b.high)}; }
  friend WideMask operator==(SimdWide a, SimdWide b) { return {hn::Eq(a.low, b.low), hn::Eq(a.high, b.high)}; }
  friend WideMask operator!=(SimdWide a, SimdWide b) { return {hn::Ne(a.low, b.low), hn::Ne(a.high, b.high)}; }
};

/// Integers of 32 bits: of pixels, codes, and edge functions counted from a tile (draw_simd.h).
struct SimdInt {
  IntVector v;
  SimdInt() = default;
  SimdInt(IntVector of) : v(of) {}
  SimdInt(std::int32_t of) : v(hn::Set(kInts, of)) {}
  friend SimdInt operator+(SimdInt a, SimdInt b) { return hn::Add(a.v, b.v); }
  friend SimdInt operator-(SimdInt a, SimdInt b) { return hn::Sub(a.v, b.v); }
  friend SimdInt operator*(SimdInt a, SimdInt b) { return hn::Mul(a.v, b.v); }
  friend SimdInt operator&(SimdInt a, SimdInt b) { return hn::And(a.v, b.v); }
  friend SimdInt operator|(SimdInt a, SimdInt b) { return hn::Or(a.v, b.v); }
  friend SimdInt operator^(SimdInt a, SimdInt b) { return hn::Xor(a.v, b.v); }
  friend SimdMask operator<(SimdInt a, SimdInt b) { return {hn::RebindMask(kFloats, hn::Lt(a.v, b.v))}; }
  friend SimdMask operator>(SimdInt a, SimdInt b) { return {hn::RebindMask(kFloats, hn::Gt(a.v, b.v))}; }
  friend SimdMask operator<=(SimdInt a, SimdInt b) { return {hn::RebindMask(kFloats, hn::Not(hn::Gt(a.v, b.v)))}; }
  friend SimdMask operator>=(SimdInt a, SimdInt b) { return {hn::RebindMask(kFloats, hn::Not(hn::Lt(a.v, b.v)))}; }
  friend SimdMask operator==(SimdInt a, SimdInt b) { return {hn::RebindMask(kFloats, hn::Eq(a.v, b.v))}; }
  friend SimdMask operator!=(SimdInt a, SimdInt b) { return {hn::RebindMask(kFloats, hn::Ne(a.v, b.v))}; }
};

inline Simd select(SimdMask mask, Simd yes, Simd no) { return hn::IfThenElse(mask.m, yes.v, no.v); }
inline SimdInt select(SimdMask mask, SimdInt yes, SimdInt no) {
  return hn::IfThenElse(hn::RebindMask(kInts, mask.m), yes.v, no.v);
}
inline SimdWide select(WideMask mask, SimdWide yes, SimdWide no) {
  return {hn::IfThenElse(mask.low, yes.low, no.low), hn::IfThenElse(mask.high, yes.high, no.high)};
}

// x86's max and min: the second where either is NaN.
inline Simd greater_of(Simd a, Simd b) { return hn::Max(a.v, b.v); }
inline Simd lesser_of(Simd a, Simd b) { return hn::Min(a.v, b.v); }
inline SimdWide greater_of(SimdWide a, SimdWide b) { return {hn::Max(a.low, b.low), hn::Max(a.high, b.high)}; }
inline SimdWide lesser_of(SimdWide a, SimdWide b) { return {hn::Min(a.low, b.low), hn::Min(a.high, b.high)}; }

inline Simd to_float(SimdWide w) {
  return hn::Combine(kFloats, hn::DemoteTo(kHalfFloats, w.high), hn::DemoteTo(kHalfFloats, w.low));
}
inline SimdWide to_wide(Simd f) {
  return {hn::PromoteTo(kDoubles, hn::LowerHalf(kHalfFloats, f.v)),
          hn::PromoteTo(kDoubles, hn::UpperHalf(kHalfFloats, f.v))};
}
inline SimdWide to_wide(SimdInt i) {
  return {hn::PromoteTo(kDoubles, hn::LowerHalf(kHalfInts, i.v)),
          hn::PromoteTo(kDoubles, hn::UpperHalf(kHalfInts, i.v))};
}
inline SimdInt to_int(Simd f) { return hn::ConvertTo(kInts, f.v); }
inline Simd to_float(SimdInt i) { return hn::ConvertTo(kFloats, i.v); }

inline Simd round_even(Simd f) { return (f + 12582912.0f) - 12582912.0f; }
inline SimdWide round_even(SimdWide w) { return (w + 6755399441055744.0) - 6755399441055744.0; }

inline void store(SimdMask mask, Simd value, float* to) { hn::BlendedStore(value.v, mask.m, kFloats, to); }
inline void store(SimdMask mask, SimdInt value, std::uint8_t* to) {
  const SimdInt held = hn::PromoteTo(kInts, hn::LoadU(kBytes, to));
  hn::StoreU(hn::DemoteTo(kBytes, select(mask, value, held).v), kBytes, to);
}

inline Simd square_root(Simd f) { return hn::Sqrt(f.v); }
inline SimdWide mantissa_of(SimdWide w) {
  const auto of = [](DoubleVector v) {
    const auto fraction = hn::And(hn::BitCast(kLongs, v), hn::Set(kLongs, 0xfffffffffffff));
    return hn::BitCast(kDoubles, hn::Or(fraction, hn::Set(kLongs, 0x3ff0000000000000)));
  };
  return {of(w.low), of(w.high)};
}
inline SimdWide exponent_of(SimdWide w) {
  // Below 2^52's leading bit: 2^52 + the biased exponent.
  const auto of = [](DoubleVector v) {
    const auto biased = hn::ShiftRight<52>(hn::BitCast(kLongs, v));
    return hn::BitCast(kDoubles, hn::Or(biased, hn::Set(kLongs, 0x4330000000000000)));
  };
  return SimdWide(of(w.low), of(w.high)) - (4503599627370496.0 + 1023.0);
}
inline SimdWide power_of_two(SimdWide n) {
  const auto of = [](DoubleVector v) { return hn::BitCast(kDoubles, hn::ShiftLeft<52>(hn::BitCast(kLongs, v))); };
  const SimdWide biased = n + (6755399441055744.0 + 1023.0);
  return {of(biased.low), of(biased.high)};
}

}  // namespace PLUMBLINE_TARGET

template <>
struct Lanes<PLUMBLINE_TARGET::Simd> {
  static constexpr int width = PLUMBLINE_TARGET::kWidth;
  using Wide = PLUMBLINE_TARGET::SimdWide;
  using Int = PLUMBLINE_TARGET::SimdInt;
  using Mask = PLUMBLINE_TARGET::SimdMask;
};

template <>
inline PLUMBLINE_TARGET::Simd load<PLUMBLINE_TARGET::Simd>(const float* from) {
  return PLUMBLINE_TARGET::hn::LoadU(PLUMBLINE_TARGET::kFloats, from);
}
template <>
inline PLUMBLINE_TARGET::SimdInt load_codes<PLUMBLINE_TARGET::Simd>(const std::uint8_t* from) {
  return PLUMBLINE_TARGET::hn::PromoteTo(PLUMBLINE_TARGET::kInts,
                                         PLUMBLINE_TARGET::hn::LoadU(PLUMBLINE_TARGET::kBytes, from));
}

template <>
inline Pixels<PLUMBLINE_TARGET::Simd> block_pixels<PLUMBLINE_TARGET::Simd>(int block_x, int block_y, int i) {
  using namespace PLUMBLINE_TARGET;
  const SimdInt number(hn::Iota(kInts, i));
  const SimdInt x = SimdInt(block_x) + (number & SimdInt(kBlock - 1));
  const SimdInt y = SimdInt(block_y) + SimdInt(hn::ShiftRight<2>(number.v));
  return {x, y, to_wide(x) + 0.5, to_wide(y) + 0.5};
}

}  // namespace plumbline::pipeline

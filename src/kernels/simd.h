// Lane operations (lanes.h) for SIMD, over Highway: each lane does what float does, bit for bit. To be included only by
// files that are compiled once for each target, PLUMBLINE_TARGET (painter/simd_kernels.cpp, a test): a namespace of
// that name keeps the targets' functions apart.
#pragma once

#include <bit>

#include <hwy/cache_control.h>
#include <hwy/highway.h>

#include "kernels/lanes.h"

namespace plumbline::pipeline {
namespace PLUMBLINE_TARGET {
namespace {  // templates over these types are the object file's own

namespace hn = hwy::HWY_NAMESPACE;

static_assert(HWY_TARGET <= HWY_SSE4, "targets narrower than SSE4 emulate operations, with other last bits");
inline constexpr int kWidth = HWY_MAX_BYTES / 4;  // lanes: 4, 8 or 16 of a block's 16 pixels
inline constexpr int kHalf = kWidth / 2;
inline constexpr hn::FixedTag<float, kWidth> kFloats{};
inline constexpr hn::FixedTag<float, kHalf> kHalfFloats{};
inline constexpr hn::FixedTag<std::int32_t, kWidth> kInts{};
inline constexpr hn::FixedTag<std::int32_t, kHalf> kHalfInts{};
inline constexpr hn::FixedTag<std::int16_t, 2 * kWidth> kShorts{};
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
inline bool all(SimdMask mask) { return hn::AllTrue(kFloats, mask.m); }
inline unsigned bits_of(SimdMask mask) {
  std::uint8_t bytes[8] = {};  // Highway writes whole bytes, as many as the lanes need
  hn::StoreMaskBits(kFloats, mask.m, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8;
}

/// One float, or one 32-bit integer, per lane. Integers: pixels, snapped positions, codes, and edge functions counted
/// from a tile.
template <class Tag>
struct SimdOf {
  using Vector = hn::Vec<Tag>;
  Vector v;
  SimdOf() = default;
  SimdOf(Vector of) : v(of) {}
  SimdOf(hn::TFromD<Tag> of) : v(hn::Set(Tag(), of)) {}
  static SimdMask mask(hn::Mask<Tag> m) { return {hn::RebindMask(kFloats, m)}; }
  friend SimdOf operator+(SimdOf a, SimdOf b) { return hn::Add(a.v, b.v); }
  friend SimdOf operator-(SimdOf a, SimdOf b) { return hn::Sub(a.v, b.v); }
  friend SimdOf operator*(SimdOf a, SimdOf b) { return hn::Mul(a.v, b.v); }
  friend SimdOf operator/(SimdOf a, SimdOf b) { return hn::Div(a.v, b.v); }
  friend SimdOf operator-(SimdOf a) { return hn::Neg(a.v); }
  friend SimdOf operator&(SimdOf a, SimdOf b) { return hn::And(a.v, b.v); }
  friend SimdOf operator|(SimdOf a, SimdOf b) { return hn::Or(a.v, b.v); }
  friend SimdOf operator^(SimdOf a, SimdOf b) { return hn::Xor(a.v, b.v); }
  friend SimdMask operator<(SimdOf a, SimdOf b) { return mask(hn::Lt(a.v, b.v)); }
  friend SimdMask operator>(SimdOf a, SimdOf b) { return mask(hn::Gt(a.v, b.v)); }
  friend SimdMask operator<=(SimdOf a, SimdOf b) {
    if constexpr (std::is_integral_v<hn::TFromD<Tag>>) {
      return mask(hn::Not(hn::Gt(a.v, b.v)));
    } else {
      return mask(hn::Le(a.v, b.v));
    }
  }
  friend SimdMask operator>=(SimdOf a, SimdOf b) { return b <= a; }
  friend SimdMask operator==(SimdOf a, SimdOf b) { return mask(hn::Eq(a.v, b.v)); }
  friend SimdMask operator!=(SimdOf a, SimdOf b) { return mask(hn::Ne(a.v, b.v)); }
  friend SimdOf select(SimdMask mask, SimdOf yes, SimdOf no) {
    return hn::IfThenElse(hn::RebindMask(Tag(), mask.m), yes.v, no.v);
  }
  // x86's max and min: the second where either is NaN.
  friend SimdOf greater_of(SimdOf a, SimdOf b) { return hn::Max(a.v, b.v); }
  friend SimdOf lesser_of(SimdOf a, SimdOf b) { return hn::Min(a.v, b.v); }
  friend hn::TFromD<Tag> greatest_lane(SimdOf of) { return hn::GetLane(hn::MaxOfLanes(Tag(), of.v)); }
  friend void store(SimdOf of, hn::TFromD<Tag>* to) { hn::StoreU(of.v, Tag(), to); }
  // Reads, selects and writes all lanes, for masked stores are slow on some machines. Memory of one thread only.
  friend void store(SimdMask mask, SimdOf of, hn::TFromD<Tag>* to) {
    store(select(mask, of, hn::LoadU(Tag(), to)), to);
  }
};
using Simd = SimdOf<hn::FixedTag<float, kWidth>>;
using SimdInt = SimdOf<hn::FixedTag<std::int32_t, kWidth>>;

/// Mask of doubles, in two halves.
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

/// One double per lane, in two halves.
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

inline SimdWide select(WideMask mask, SimdWide yes, SimdWide no) {
  return {hn::IfThenElse(mask.low, yes.low, no.low), hn::IfThenElse(mask.high, yes.high, no.high)};
}
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

inline void store(SimdMask mask, SimdInt value, std::uint8_t* to) {
  const SimdInt held = hn::PromoteTo(kInts, hn::LoadU(kBytes, to));
  hn::StoreU(hn::DemoteTo(kBytes, select(mask, value, held).v), kBytes, to);
}

inline SimdWide floor_of(SimdWide w) { return {hn::Floor(w.low), hn::Floor(w.high)}; }
inline SimdInt to_int(SimdWide w) {
  const SimdWide counted = w + 6755399441055744.0;  // 1.5 * 2^52: the integer stands in the lowest bits
  return hn::ConcatEven(kInts, hn::BitCast(kInts, counted.high), hn::BitCast(kInts, counted.low));
}

inline Simd square_root(Simd f) { return hn::Sqrt(f.v); }
inline void store(SimdWide value, double* to) {
  hn::StoreU(value.low, kDoubles, to);
  hn::StoreU(value.high, kDoubles, to + kHalf);
}
inline void store_kept(SimdMask mask, SimdInt value, std::int32_t* to) {
  if constexpr (kWidth == 16) {
    hn::StoreU(hn::Compress(value.v, hn::RebindMask(kInts, mask.m)), kInts, to);
  } else {  // no Compress: below AVX-512 it is made of tables, and unoptimised builds then need Highway's library
    HWY_ALIGN std::int32_t lanes[kWidth];
    hn::Store(value.v, kInts, lanes);
    for (unsigned bits = bits_of(mask); bits != 0; bits &= bits - 1) *to++ = lanes[std::countr_zero(bits)];
  }
}
inline void stream(SimdInt value, std::int32_t* to) { hn::Stream(value.v, kInts, to); }
inline void store_codes(SimdInt value, std::uint8_t* to) { hn::StoreU(hn::DemoteTo(kBytes, value.v), kBytes, to); }
inline void store_packed(SimdMask mask, SimdInt value, std::uint32_t* to) {
  store(mask, value, reinterpret_cast<std::int32_t*>(to));
}

inline bool any(WideMask mask) { return !hn::AllFalse(kDoubles, mask.low) || !hn::AllFalse(kDoubles, mask.high); }
inline bool all(WideMask mask) { return hn::AllTrue(kDoubles, mask.low) && hn::AllTrue(kDoubles, mask.high); }
template <int n>
SimdInt shifted_left(SimdInt value) {
  return hn::ShiftLeft<n>(value.v);
}
template <int n>
SimdInt shifted_right(SimdInt value) {
  return hn::ShiftRight<n>(value.v);
}
inline SimdInt as_int(Simd value) { return hn::BitCast(kInts, value.v); }
inline Simd as_float(SimdInt bits) { return hn::BitCast(kFloats, bits.v); }
// x86 intrinsics. rounded(): nearest, half to even; INT_MIN for NaN and beyond the range of an int. to_bytes():
// saturating packs, by blocks of 128 bits.
inline __m128i rounded(__m128 v) { return _mm_cvtps_epi32(v); }
inline __m128i to_bytes(__m128i a, __m128i b) { return _mm_packus_epi16(a, b); }
#if HWY_TARGET <= HWY_AVX2
inline __m256i rounded(__m256 v) { return _mm256_cvtps_epi32(v); }
inline __m256i to_bytes(__m256i a, __m256i b) { return _mm256_packus_epi16(a, b); }
#endif
#if HWY_TARGET <= HWY_AVX3
// Masked by all ones: GCC 12 warns that _mm512_cvtps_epi32's own operand is uninitialized (PR 105593).
inline __m512i rounded(__m512 v) { return _mm512_maskz_cvtps_epi32(0xffff, v); }
inline __m512i to_bytes(__m512i a, __m512i b) { return _mm512_packus_epi16(a, b); }
#endif
inline SimdInt packed(SimdInt r, SimdInt g, SimdInt b, SimdInt a) {
  const auto shorts = [](SimdInt low, SimdInt high) { return hn::ReorderDemote2To(kShorts, low.v, high.v).raw; };
  const IntVector codes{to_bytes(shorts(r, g), shorts(b, a))};
  HWY_ALIGN static constexpr std::int32_t kByPixel[4] = {0x0c080400, 0x0d090501, 0x0e0a0602, 0x0f0b0703};
  return hn::TableLookupBytes(codes, hn::LoadDup128(kInts, kByPixel));
}
inline SimdInt packed_codes_near(Simd r, Simd g, Simd b, Simd a) {
  const auto code = [](Simd value) { return IntVector{rounded(value.v.raw)}; };
  return packed(code(r), code(g), code(b), code(a));
}
inline SimdInt packed_codes(Simd r, Simd g, Simd b, Simd a) {
  const auto least = [](Simd value) { return lesser_of(Simd(255.0f), value); };  // NaN stays NaN
  return packed_codes_near(least(r), least(g), least(b), least(a));
}
inline SimdInt nearest_int(SimdWide value) { return to_int(value); }
inline SimdInt nearest_int(Simd value) { return hn::NearestInt(value.v); }

#if HWY_NATIVE_FMA
inline Simd fused(Simd a, Simd b, Simd c) { return hn::MulAdd(a.v, b.v, c.v); }
inline SimdWide fused(SimdWide a, SimdWide b, SimdWide c) {
  return {hn::MulAdd(a.low, b.low, c.low), hn::MulAdd(a.high, b.high, c.high)};
}
#else
inline Simd fused(Simd a, Simd b, Simd c) {
  HWY_ALIGN float of[3][kWidth];
  store(a, of[0]), store(b, of[1]), store(c, of[2]);
  for (int i = 0; i < kWidth; ++i) of[0][i] = std::fma(of[0][i], of[1][i], of[2][i]);
  return hn::Load(kFloats, of[0]);
}
inline SimdWide fused(SimdWide a, SimdWide b, SimdWide c) {
  HWY_ALIGN double of[3][kWidth];
  store(a, of[0]), store(b, of[1]), store(c, of[2]);
  for (int i = 0; i < kWidth; ++i) of[0][i] = std::fma(of[0][i], of[1][i], of[2][i]);
  return {hn::Load(kDoubles, of[0]), hn::Load(kDoubles, of[0] + kHalf)};
}
#endif

inline SimdWide mantissa_of(SimdWide w) {
  const auto of = [](DoubleVector v) {
    const auto fraction = hn::And(hn::BitCast(kLongs, v), hn::Set(kLongs, 0xfffffffffffff));
    return hn::BitCast(kDoubles, hn::Or(fraction, hn::Set(kLongs, 0x3ff0000000000000)));
  };
  return {of(w.low), of(w.high)};
}
inline SimdWide exponent_of(SimdWide w) {
  // The biased exponent in the mantissa of 2^52 makes the double 2^52 + biased exponent.
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

// Four floats of one lane, or two integers of two lanes, are one block of 128 bits. of_blocks(): block(0), block(4)
// and so on.
inline constexpr hn::FixedTag<float, 4> kBlockFloats{};
inline constexpr hn::FixedTag<std::int32_t, 4> kBlockInts{};
inline constexpr hn::FixedTag<std::int32_t, 2> kTwoInts{};
template <class Tag, class Block>
[[gnu::always_inline]] inline hn::Vec<Tag> of_blocks(Tag all, Block block) {
  if constexpr (kWidth == 4) {
    return block(0);
  } else if constexpr (kWidth == 8) {
    return hn::Combine(all, block(4), block(0));
  } else {
    constexpr hn::Half<Tag> half{};
    return hn::Combine(all, hn::Combine(half, block(12), block(8)), hn::Combine(half, block(4), block(0)));
  }
}

inline Vec4<Simd> transposed(const Vec4<Simd>& in) {
  const auto wide = [](FloatVector v) { return hn::BitCast(kDoubles, v); };
  const auto low = hn::InterleaveLower(kFloats, in[0].v, in[1].v),
             high = hn::InterleaveUpper(kFloats, in[0].v, in[1].v);
  const auto low2 = hn::InterleaveLower(kFloats, in[2].v, in[3].v),
             high2 = hn::InterleaveUpper(kFloats, in[2].v, in[3].v);
  const auto pairs = [](auto of) { return Simd(hn::BitCast(kFloats, of)); };
  return {pairs(hn::InterleaveLower(kDoubles, wide(low), wide(low2))),
          pairs(hn::InterleaveUpper(kDoubles, wide(low), wide(low2))),
          pairs(hn::InterleaveLower(kDoubles, wide(high), wide(high2))),
          pairs(hn::InterleaveUpper(kDoubles, wide(high), wide(high2)))};
}
inline void store_twos(SimdInt first, SimdInt second, std::int32_t* to) {
  hn::StoreInterleaved2(first.v, second.v, kInts, to);
}
[[gnu::always_inline]] inline void store_fours(const Vec4<Simd>& values, float* const (&to)[kWidth]) {
  const Vec4<Simd> rows = transposed(values);
  for (int i = 0; i < 4; ++i) {
    HWY_ALIGN float lanes[kWidth];
    hn::Store(rows[i].v, kFloats, lanes);
    for (int block = 0; block < kWidth; block += 4) {
      hn::StoreU(hn::Load(kBlockFloats, lanes + block), kBlockFloats, to[block + i]);
    }
  }
}
// Vector of kHalf doubles: two of a lane's four numbers (kHalf 2), all four (4), or all of two lanes (8).
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
[[gnu::always_inline]] inline Vec4<Simd> fours_of_rows(const SimdWide (&rows)[4]) {
  return transposed({to_float(rows[0]), to_float(rows[1]), to_float(rows[2]), to_float(rows[3])});
}

struct LanesOfSimd {
  static constexpr int width = kWidth;
  using Wide = SimdWide;
  using Int = SimdInt;
  using Mask = SimdMask;
  static Simd load(const float* from) { return hn::LoadU(kFloats, from); }
  static Wide load(const double* from) { return {hn::LoadU(kDoubles, from), hn::LoadU(kDoubles, from + kHalf)}; }
  static Int load(const std::int32_t* from) { return hn::LoadU(kInts, from); }
  static Int load(const std::uint32_t* from) { return load(reinterpret_cast<const std::int32_t*>(from)); }
  static Int load(const std::uint8_t* from) { return hn::PromoteTo(kInts, hn::LoadU(kBytes, from)); }
  static Simd load_row(const float* from) {
    return of_blocks(kFloats, [&](int lane) { return hn::LoadU(kBlockFloats, from + lane * kBlock); });
  }
  static Vec3<Simd> load_threes(const float* from) {
    Vec3<Simd> out;
    hn::LoadInterleaved3(kFloats, from, out.x.v, out.y.v, out.z.v);
    return out;
  }
  [[gnu::always_inline]] static std::array<Int, 2> load_twos(auto at) {
    const auto block = [&](int lane) {
      const auto two = [&](int of) { return hn::LoadU(kTwoInts, at(of)); };
      return hn::Combine(kBlockInts, two(lane + 1), two(lane));
    };
    const IntVector low = of_blocks(kInts, [&](int lane) { return block(lane / 2); }),
                    high = of_blocks(kInts, [&](int lane) { return block(kHalf + lane / 2); });
    return {Int(hn::ConcatEven(kInts, high, low)), Int(hn::ConcatOdd(kInts, high, low))};
  }
  [[gnu::always_inline]] static Vec4<Simd> load_fours(const float* const (&from)[kWidth]) {
    const auto row = [&](int i) {
      return of_blocks(kFloats, [&](int lane) { return hn::LoadU(kBlockFloats, from[lane + i]); });
    };
    return transposed({Simd(row(0)), Simd(row(1)), Simd(row(2)), Simd(row(3))});
  }
  static Mask mask_of(unsigned bits) {
    HWY_ALIGN static constexpr std::int32_t kBits[] = {1,   2,   4,    8,    16,   32,   64,    128,
                                                       256, 512, 1024, 2048, 4096, 8192, 16384, 32768};
    return (Int(static_cast<std::int32_t>(bits)) & load(kBits)) != Int(0);
  }
  // Equal halves are one value, so that the compiler computes with it once.
  [[gnu::always_inline]] static Wide columns_of_block(int block_x, int) {
    HWY_ALIGN static constexpr double kX[2 * kBlock] = {0, 1, 2, 3, 0, 1, 2, 3};
    const auto x = hn::Set(kDoubles, block_x), low = hn::Add(x, hn::LoadU(kDoubles, kX));
    return {low, kHalf < kBlock ? hn::Add(x, hn::LoadU(kDoubles, kX + kHalf)) : low};
  }
  [[gnu::always_inline]] static Wide rows_of_block(int block_y, int i) {
    HWY_ALIGN static constexpr double kY[kBlockPixels] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
    const auto y = hn::Set(kDoubles, block_y), low = hn::Add(y, hn::LoadU(kDoubles, kY + i));
    return {low, kHalf < kBlock ? low : hn::Add(y, hn::LoadU(kDoubles, kY + i + kHalf))};
  }
  static void end_of_stream() { hwy::FlushStream(); }
};

}  // namespace
}  // namespace PLUMBLINE_TARGET

template <>
struct Lanes<PLUMBLINE_TARGET::Simd> : PLUMBLINE_TARGET::LanesOfSimd {};

}  // namespace plumbline::pipeline

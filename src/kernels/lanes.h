// Lane operations: the primitives of the kernels, so that one source serves every width.
//
// A kernel is a template over its number type R. R = float, below, is the definition: each operation is the scalar one.
// A SIMD type has its own Lanes and all these operations; each lane yields float's result.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "capture/stages.h"

namespace plumbline::pipeline {

inline constexpr int kBlock = 4;  ///< side of a block [pixels]: tiles are walked and stored block by block
inline constexpr int kBlockPixels = kBlock * kBlock;

/// Types that go with a number type R of `width` lanes: as many doubles (Wide), integers (Int; 64 bits for float, 32
/// for SIMD) and bits (Mask); and functions that make them from memory and plain numbers.
template <class R>
struct Lanes;
template <>
struct Lanes<float> {
  static constexpr int width = 1;
  using Wide = double;
  using Int = std::int64_t;
  using Mask = bool;
  /// The next `width` values. uint32_t: as bits, for a SIMD lane is signed. uint8_t: codes [0, 255].
  static float load(const float* from) { return *from; }
  static Wide load(const double* from) { return *from; }
  static Int load(const std::int32_t* from) { return *from; }
  static Int load(const std::uint32_t* from) { return *from; }
  static Int load(const std::uint8_t* from) { return *from; }
  /// The next `width` values of a row of a tile stored block by block: from[0..3], from[16..19], ...
  static float load_row(const float* from) { return *from; }
  /// Three floats per lane, lane after lane in memory.
  static Vec3<float> load_threes(const float* from) { return {from[0], from[1], from[2]}; }
  /// Two integers per lane, each lane's side by side at the address at(lane).
  static std::array<Int, 2> load_twos(auto at) { return {at(0)[0], at(0)[1]}; }
  /// Four floats per lane, each lane's from its own address.
  static Vec4<float> load_fours(const float* const (&from)[1]) {
    return {from[0][0], from[0][1], from[0][2], from[0][3]};
  }
  /// Mask of the lanes whose bits are set, lane 0 the lowest. (Float: any bit sets the one lane.)
  static Mask mask_of(unsigned bits) { return bits != 0; }
  /// Columns and rows of a block's pixels from the i-th on, row by row.
  static Wide columns_of_block(int block_x, int i) { return block_x + i % kBlock; }
  static Wide rows_of_block(int block_y, int i) { return block_y + i / kBlock; }
  /// Makes stream()'s stores visible to other threads.
  static void end_of_stream() {}
};
template <class R>
using Wide = typename Lanes<R>::Wide;
template <class R>
using Int = typename Lanes<R>::Int;
template <class R>
using Mask = typename Lanes<R>::Mask;

/// One pixel per lane.
template <class R>
struct Pixels {
  Int<R> x, y;           ///< column and row
  Wide<R> x_win, y_win;  ///< centre, window space
};

inline float to_float(double value) { return static_cast<float>(value); }
inline double to_wide(float value) { return static_cast<double>(value); }
/// Conversions of whole numbers that both types hold exactly.
inline std::int64_t to_int(float value) { return static_cast<std::int64_t>(value); }
inline float to_float(std::int64_t value) { return static_cast<float>(value); }
inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }
/// One bit a lane, the first lowest.
inline unsigned bits_of(bool mask) { return mask ? 1 : 0; }
inline float select(bool mask, float yes, float no) { return mask ? yes : no; }
inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
inline std::int64_t select(bool mask, std::int64_t yes, std::int64_t no) { return mask ? yes : no; }

/// Maximum and minimum; `b` where either is NaN.
template <class T>
T greater_of(T a, T b) {
  return a > b ? a : b;
}
template <class T>
T lesser_of(T a, T b) {
  return a < b ? a : b;
}

/// `value` clamped to [low, high]; NaN becomes `low`.
template <class T>
T clamped(T value, T low, T high) {
  return lesser_of(greater_of(value, low), high);
}
/// `value` clamped to [0,1]; NaN becomes 0.
template <class T>
T clamp01(T value) {
  return clamped(value, T(0), T(1));
}

/// Nearest whole number, half to even, for |value| below 2^22 (float) or 2^51 (double): adding 1.5 * 2^mantissa leaves
/// no fraction.
inline float round_even(float value) { return (value + 12582912.0f) - 12582912.0f; }
inline double round_even(double value) { return (value + 6755399441055744.0) - 6755399441055744.0; }

/// Greatest whole number <= value.
inline double floor_of(double value) { return std::floor(value); }
/// Conversions of whole numbers, |value| below 2^51. SIMD: to_int() keeps the lowest 32 bits.
inline std::int64_t to_int(double value) { return static_cast<std::int64_t>(value); }
inline double to_wide(std::int64_t value) { return static_cast<double>(value); }
/// Nearest whole number, half to even, for |value| below 2^31.
inline std::int64_t nearest_int(double value) { return to_int(round_even(value)); }
inline std::int64_t nearest_int(float value) { return static_cast<std::int64_t>(std::nearbyint(value)); }
/// a b + c, rounded once (FMA).
inline float fused(float a, float b, float c) { return std::fma(a, b, c); }
inline double fused(double a, double b, double c) { return std::fma(a, b, c); }

template <int n>
std::int64_t shifted_left(std::int64_t value) {
  return value << n;
}
/// value / 2^n, rounded down.
template <int n>
std::int64_t shifted_right(std::int64_t value) {
  return value >> n;
}
/// Bits of a float as a signed integer, and back.
inline std::int64_t as_int(float value) { return std::bit_cast<std::int32_t>(value); }
inline float as_float(std::int64_t bits) { return std::bit_cast<float>(static_cast<std::int32_t>(bits)); }

template <class R>
R magnitude(R value) {
  return as_float(as_int(value) & Int<R>(0x7fffffff));
}
inline float square_root(float value) { return std::sqrt(value); }
/// Mantissa [1, 2) and exponent of a positive normal number.
inline double mantissa_of(double value) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(value) & 0xfffffffffffff) | 0x3ff0000000000000);
}
inline double exponent_of(double value) {
  return static_cast<double>(std::bit_cast<std::uint64_t>(value) >> 52) - 1023.0;
}
/// 2^n for a whole n in [-1022, 1023].
inline double power_of_two(double n) {  // 1.5 * 2^52: leaves the biased exponent in the lowest bits
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(n + (6755399441055744.0 + 1023.0)) << 52);
}

/// Masked stores of `width` values from `to` on.
inline void store(bool mask, float value, float* to) {
  if (mask) *to = value;
}
/// `value`: [0, 255].
inline void store(bool mask, std::int64_t value, std::uint8_t* to) {
  if (mask) *to = static_cast<std::uint8_t>(value);
}

/// Codes of rgba8 from channels times 255: clamped to [0, 255] (NaN to 0), rounded half to even; r in the lowest byte.
inline std::int64_t packed_codes(float r, float g, float b, float a) {
  const auto code = [](float value) { return to_int(round_even(clamped(value, 0.0f, 255.0f))); };
  return code(r) | code(g) << 8 | code(b) << 16 | code(a) << 24;
}
/// packed_codes() of channels whose magnitude is below 2^31: SIMD needs no clamp before the conversion.
inline std::int64_t packed_codes_near(float r, float g, float b, float a) { return packed_codes(r, g, b, a); }
inline void store_packed(bool mask, std::int64_t value, std::uint32_t* to) {
  if (mask) *to = static_cast<std::uint32_t>(value);
}
/// Unmasked stores of `width` values from `to` on.
inline void store(float value, float* to) { *to = value; }
inline void store(double value, double* to) { *to = value; }
inline void store(std::int64_t value, std::int32_t* to) { *to = static_cast<std::int32_t>(value); }
/// Stores the lanes of `mask` side by side from `to` on. The rest of the `width` values there may be overwritten.
inline void store_kept(bool, std::int64_t value, std::int32_t* to) { *to = static_cast<std::int32_t>(value); }
/// Non-temporal store of `width` values; `to` is aligned to 4 width bytes. Lanes<R>::end_of_stream() makes it visible
/// to other threads.
inline void stream(std::int64_t value, std::int32_t* to) { *to = static_cast<std::int32_t>(value); }
/// Stores each lane, [0, 255], as one byte.
inline void store_codes(std::int64_t value, std::uint8_t* to) { *to = static_cast<std::uint8_t>(value); }

/// Stores two integers per lane, lane after lane in memory.
inline void store_twos(std::int64_t first, std::int64_t second, std::int32_t* to) {
  store(first, to), store(second, to + 1);
}
/// Stores four floats per lane, each lane's at its own address.
inline void store_fours(const Vec4<float>& values, float* const (&to)[1]) {
  for (int i = 0; i < 4; ++i) to[0][i] = values[i];
}

/// row_of_fours(): vector `row` [0, 3] of the four vectors of doubles that hold the lanes' vec4 at at(lane). Float:
/// component `row`. SIMD: all components of some of the lanes; fours_of_rows() transposes the four vectors.
/// row_of_shares(): the lanes' weights k, in the lane order of row_of_fours(). The first argument selects the overload
/// by its type.
inline double row_of_fours(float, int row, auto at) { return to_wide(at(0)[row]); }
inline double row_of_shares(float, int, const double (&k)[1]) { return k[0]; }
inline Vec4<float> fours_of_rows(const double (&rows)[4]) { return {rows[0], rows[1], rows[2], rows[3]}; }

/// Maximum over the lanes.
inline float greatest_lane(float value) { return value; }
inline int greatest_lane(std::int64_t value) { return static_cast<int>(value); }

/// Pixels i to i + width - 1, row by row, of the block whose first pixel is (block_x, block_y).
template <class R>
Pixels<R> block_pixels(int block_x, int block_y, int i) {
  const Wide<R> x = Lanes<R>::columns_of_block(block_x, i), y = Lanes<R>::rows_of_block(block_y, i);
  return {to_int(x), to_int(y), x + 0.5, y + 0.5};
}

}  // namespace plumbline::pipeline

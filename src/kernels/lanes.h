// Lane operations: the primitives of the per-pixel kernels (stages 5 to 11), so that one source serves every width.
//
// A kernel is a template over its number type R. For R = float, below, each operation is the plain one on one pixel:
// this is the definition. A SIMD type needs its own Lanes and the same operations, each lane doing the same.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "capture/stages.h"

namespace plumbline::pipeline {

inline constexpr int kBlock = 4;  ///< pixels a side: the unit in which triangles are walked and planes are stored
inline constexpr int kBlockPixels = kBlock * kBlock;

/// The companions of a number type: `width` pixels at a time, doubles (Wide), integers (Int) and a Mask of as many; and
/// what makes them of memory and plain numbers.
template <class R>
struct Lanes;
template <>
struct Lanes<float> {
  static constexpr int width = 1;
  using Wide = double;
  using Int = std::int64_t;
  using Mask = bool;
  /// The next `width` values. Integers: of 32 bits, or codes from 0 to 255.
  static float load(const float* from) { return *from; }
  static Wide load(const double* from) { return *from; }
  static Int load(const std::int32_t* from) { return *from; }
  static Int load(const std::uint32_t* from) { return *from; }
  static Int load(const std::uint8_t* from) { return *from; }
  /// The next `width` values of a row of pixels: four of each block, from block to block.
  static float load_row(const float* from) { return *from; }
  /// Each lane's three floats, which lie side by side in memory lane after lane; its four, from where its pointer says.
  static Vec3<float> load_threes(const float* from) { return {from[0], from[1], from[2]}; }
  static Vec4<float> load_fours(const float* const (&from)[1]) {
    return {from[0][0], from[0][1], from[0][2], from[0][3]};
  }
  /// The lanes of those bits, the first the lowest.
  static Mask mask_of(unsigned bits) { return bits != 0; }
  /// Columns and rows of a block's pixels from the i-th on, row by row.
  static Wide columns_of_block(int block_x, int i) { return block_x + i % kBlock; }
  static Wide rows_of_block(int block_y, int i) { return block_y + i / kBlock; }
  static void end_of_stream() {}
};
template <class R>
using Wide = typename Lanes<R>::Wide;
template <class R>
using Int = typename Lanes<R>::Int;
template <class R>
using Mask = typename Lanes<R>::Mask;

template <class R>
struct Pixels {
  Int<R> x, y;           ///< pixel
  Wide<R> x_win, y_win;  ///< centre
};

inline float to_float(double value) { return static_cast<float>(value); }
inline double to_wide(float value) { return static_cast<double>(value); }
/// Conversions of whole numbers.
inline std::int64_t to_int(float value) { return static_cast<std::int64_t>(value); }
inline float to_float(std::int64_t value) { return static_cast<float>(value); }
inline bool any(bool mask) { return mask; }
inline bool all(bool mask) { return mask; }
/// One bit a lane, the first lowest.
inline unsigned bits_of(bool mask) { return mask ? 1 : 0; }
inline float select(bool mask, float yes, float no) { return mask ? yes : no; }
inline double select(bool mask, double yes, double no) { return mask ? yes : no; }
inline std::int64_t select(bool mask, std::int64_t yes, std::int64_t no) { return mask ? yes : no; }

/// The larger, and the smaller; the second where either is NaN.
template <class T>
T greater_of(T a, T b) {
  return a > b ? a : b;
}
template <class T>
T lesser_of(T a, T b) {
  return a < b ? a : b;
}

/// To [low, high]; NaN to low.
template <class T>
T clamped(T value, T low, T high) {
  return lesser_of(greater_of(value, low), high);
}
/// To [0,1]; NaN to 0.
template <class T>
T clamp01(T value) {
  return clamped(value, T(0), T(1));
}

/// Half to even, for |value| below 2^22 (float) or 2^51 (double): adding 1.5 * 2^mantissa leaves no fraction.
inline float round_even(float value) { return (value + 12582912.0f) - 12582912.0f; }
inline double round_even(double value) { return (value + 6755399441055744.0) - 6755399441055744.0; }

/// The whole number below.
inline double floor_of(double value) { return std::floor(value); }
/// Conversions of whole numbers below 2^51; of a SIMD type their lowest 32 bits.
inline std::int64_t to_int(double value) { return static_cast<std::int64_t>(value); }
inline double to_wide(std::int64_t value) { return static_cast<double>(value); }
/// The nearest, half to even, of |value| below 2^31.
inline std::int64_t nearest_int(double value) { return to_int(round_even(value)); }
inline std::int64_t nearest_int(float value) { return static_cast<std::int64_t>(std::nearbyint(value)); }
/// a b + c, rounded once.
inline float fused(float a, float b, float c) { return std::fma(a, b, c); }
inline double fused(double a, double b, double c) { return std::fma(a, b, c); }

template <int n>
std::int64_t shifted_left(std::int64_t value) {
  return value << n;
}
/// Rounded down.
template <int n>
std::int64_t shifted_right(std::int64_t value) {
  return value >> n;
}
/// A float's bits as a number, and back.
inline std::int64_t as_int(float value) { return std::bit_cast<std::int32_t>(value); }
inline float as_float(std::int64_t bits) { return std::bit_cast<float>(static_cast<std::int32_t>(bits)); }

template <class R>
R magnitude(R value) {
  return as_float(as_int(value) & Int<R>(0x7fffffff));
}
inline float square_root(float value) { return std::sqrt(value); }
/// Mantissa in [1, 2) and exponent of a positive normal number; and 2^n for a whole n from -1022 to 1023.
inline double mantissa_of(double value) {
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(value) & 0xfffffffffffff) | 0x3ff0000000000000);
}
inline double exponent_of(double value) {
  return static_cast<double>(std::bit_cast<std::uint64_t>(value) >> 52) - 1023.0;
}
inline double power_of_two(double n) {  // 1.5 * 2^52: leaves the biased exponent in the lowest bits
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(n + (6755399441055744.0 + 1023.0)) << 52);
}

inline void store(bool mask, float value, float* to) {
  if (mask) *to = value;
}
/// Whole numbers from 0 to 255.
inline void store(bool mask, std::int64_t value, std::uint8_t* to) {
  if (mask) *to = static_cast<std::uint8_t>(value);
}

/// To [0, 255], NaN to 0, and rounded half to even; the first in the lowest byte.
inline std::int64_t packed_codes(float r, float g, float b, float a) {
  const auto code = [](float value) { return to_int(round_even(clamped(value, 0.0f, 255.0f))); };
  return code(r) | code(g) << 8 | code(b) << 16 | code(a) << 24;
}
/// packed_codes() of |value| below 2^31.
inline std::int64_t packed_codes_near(float r, float g, float b, float a) { return packed_codes(r, g, b, a); }
inline void store_packed(bool mask, std::int64_t value, std::uint32_t* to) {
  if (mask) *to = static_cast<std::uint32_t>(value);
}
/// All lanes, side by side.
inline void store(float value, float* to) { *to = value; }
inline void store(double value, double* to) { *to = value; }
inline void store(std::int64_t value, std::int32_t* to) { *to = static_cast<std::int32_t>(value); }
/// The lanes of `mask` side by side; behind them, up to as many as there are lanes, anything.
inline void store_kept(bool, std::int64_t value, std::int32_t* to) { *to = static_cast<std::int32_t>(value); }
/// A store past the caches, to a place that is a multiple of the lanes' size. Lanes<R>::end_of_stream() makes it seen by
/// other threads.
inline void stream(std::int64_t value, std::int32_t* to) { *to = static_cast<std::int32_t>(value); }
/// Bytes of whole numbers from 0 to 255.
inline void store_codes(std::int64_t value, std::uint8_t* to) { *to = static_cast<std::uint8_t>(value); }

/// Each lane's four floats, to where its pointer says.
inline void store_fours(const Vec4<float>& values, float* const (&to)[1]) {
  for (int i = 0; i < 4; ++i) to[0][i] = values[i];
}

/// Vector row [0, 3] of the four that hold the lanes' vec4 at at(lane), widened to double. Float: component row. SIMD:
/// all components of some of the lanes, which fours_of_rows() transposes. row_of_shares: the lanes' weights k in that
/// arrangement. The first argument selects the overload by its type.
inline double row_of_fours(float, int row, auto at) { return to_wide(at(0)[row]); }
inline double row_of_shares(float, int, const double (&k)[1]) { return k[0]; }
inline Vec4<float> fours_of_rows(const double (&rows)[4]) { return {rows[0], rows[1], rows[2], rows[3]}; }

inline float greatest_lane(float value) { return value; }
inline int greatest_lane(std::int64_t value) { return static_cast<int>(value); }

/// The next Lanes<R>::width pixels of the block at (block_x, block_y), from its i-th on.
template <class R>
Pixels<R> block_pixels(int block_x, int block_y, int i) {
  const Wide<R> x = Lanes<R>::columns_of_block(block_x, i), y = Lanes<R>::rows_of_block(block_y, i);
  return {to_int(x), to_int(y), x + 0.5, y + 0.5};
}

}  // namespace plumbline::pipeline

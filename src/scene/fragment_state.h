// State of a draw's depth, alpha and stencil tests, polygon offset and logic op: the part of scene.h about fragments.
#pragma once

#include <cstdint>

namespace plumbline {

/// Comparison that a fragment must pass: its depth with the stored one, its alpha with a reference, the stencil
/// reference with the stored value.
enum class DepthFunc { never, less, equal, less_equal, greater, not_equal, greater_equal, always };
using CompareFunc = DepthFunc;

/// glDepthRange: the window z of the near and the far plane, [0,1] each; either may be the larger.
struct DepthRange {
  float near = 0, far = 1;
  bool operator==(const DepthRange&) const = default;
};

/// glPolygonOffset: factor * m + units * r is added to a filled triangle's depths. m is the larger of |dz/dx| and
/// |dz/dy| [window z per pixel], r a depth step (polygon_offset_unit() of scene.h; OpenGL 2.1 spec 3.5.5). Lines and
/// points, those of unfilled triangles included, are not offset.
struct PolygonOffset {
  float factor = 0, units = 0;
  bool operator==(const PolygonOffset&) const = default;
};

/// glAlphaFunc (OpenGL 2.1 spec 4.1.4): a fragment passes if `alpha func reference` holds, both in the frame's format.
struct AlphaTest {
  CompareFunc func = CompareFunc::always;
  float reference = 0;  ///< [0,1]
};

enum class StencilOp { keep, zero, replace, increment, increment_wrap, decrement, decrement_wrap, invert };

/// glStencilFunc, glStencilOp, glStencilMask (OpenGL 2.1 spec 4.1.5). The test passes if (reference & mask) func
/// (stored & mask) holds.
struct StencilFace {
  CompareFunc func = CompareFunc::always;
  std::uint8_t reference = 0, mask = 0xff;
  StencilOp fail = StencilOp::keep;        ///< where the stencil test fails
  StencilOp depth_fail = StencilOp::keep;  ///< where it passes and the depth test fails
  StencilOp pass = StencilOp::keep;        ///< where both pass
  std::uint8_t write_mask = 0xff;          ///< the bits that an op may change
  bool operator==(const StencilFace&) const = default;
};
/// `back`: state of back-facing triangles and their outlines. `front`: state of all other primitives.
struct Stencil {
  StencilFace front, back;
};

/// glLogicOp's operations, in the order of GL's constants. s: the fragment's code, d: the stored code.
enum class LogicOp {
  clear,          ///< 0
  and_,           ///< s & d
  and_reverse,    ///< s & ~d
  copy,           ///< s
  and_inverted,   ///< ~s & d
  noop,           ///< d
  xor_,           ///< s ^ d
  or_,            ///< s | d
  nor,            ///< ~(s | d)
  equivalent,     ///< ~(s ^ d)
  invert,         ///< ~d
  or_reverse,     ///< s | ~d
  copy_inverted,  ///< ~s
  or_inverted,    ///< ~s | d
  nand,           ///< ~(s & d)
  set             ///< all bits
};

}  // namespace plumbline

// What a draw says of its fragments' tests, and of their logic op: plain structs of scene.h.
#pragma once

#include <cstdint>

namespace plumbline {

/// How two numbers are compared: a depth with the one that is held, alpha and stencil values with a reference.
enum class DepthFunc { never, less, equal, less_equal, greater, not_equal, greater_equal, always };
using CompareFunc = DepthFunc;

/// glDepthRange: the window z of the near and the far plane, [0,1] each; either may be the larger.
struct DepthRange {
  float near = 0, far = 1;
  bool operator==(const DepthRange&) const = default;
};

/// glPolygonOffset: a triangle's depths move by factor * m + units * r, m its steepest slope along x or y, per pixel,
/// and r a step (scene.h, polygon_offset_unit; OpenGL 2.1 spec 3.5.5). Lines and points have none.
struct PolygonOffset {
  float factor = 0, units = 0;
  bool operator==(const PolygonOffset&) const = default;
};

/// glAlphaFunc (OpenGL 2.1 spec 4.1.4): fragments are dropped whose alpha, in the frame's format, does not compare so
/// with the reference in that format.
struct AlphaTest {
  CompareFunc func = CompareFunc::always;
  float reference = 0;  ///< [0,1]
};

enum class StencilOp { keep, zero, replace, increment, increment_wrap, decrement, decrement_wrap, invert };

/// glStencilFunc, glStencilOp, glStencilMask (OpenGL 2.1 spec 4.1.5): (reference & mask) is compared with (held &
/// mask).
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

/// glLogicOp, in its order: s the fragment's code, d what is stored.
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

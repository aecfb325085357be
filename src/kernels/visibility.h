// The tests between a fragment's colour and its place in the frame, in OpenGL's order (2.1 spec, chapter 4.1): alpha,
// stencil, depth. Scissor is coverage's (coverage.h).
#pragma once

#include "kernels/lanes.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Whether `a func b` holds. Depth test: incoming, stored; alpha test: incoming, reference; stencil test: reference,
/// stored.
template <class R, class T>
Mask<R> compares(CompareFunc func, T a, T b) {
  switch (func) {
    case CompareFunc::never: return a != a;
    case CompareFunc::less: return a < b;
    case CompareFunc::equal: return a == b;
    case CompareFunc::less_equal: return a <= b;
    case CompareFunc::greater: return a > b;
    case CompareFunc::not_equal: return a != b;
    case CompareFunc::greater_equal: return a >= b;
    case CompareFunc::always: return a == a;
  }
  return a == a;
}

/// Alpha test. `scale`: the frame's largest colour code; 0: float, compared as it is. Codes are made in double, where
/// the product of a float and a scale is exact and its rounding correct.
template <class R>
Mask<R> alpha_passes(const AlphaTest& test, R alpha, float scale) {
  using W = Wide<R>;
  const W value = to_wide(alpha), reference(static_cast<double>(test.reference));
  if (scale == 0.0f) return compares<R>(test.func, value, reference);
  return compares<R>(test.func, round_even(clamp01(value) * scale), round_even(reference * scale));
}

/// Stencil function. `held`: stored values [0, 255].
template <class R>
Mask<R> stencil_passes(const StencilFace& face, Int<R> held) {
  return compares<R>(face.func, Int<R>(face.reference & face.mask), held & Int<R>(face.mask));
}

/// Stencil value [0, 255] that an op makes of the stored one.
template <class R>
Int<R> stencil_value(StencilOp op, std::uint8_t reference, Int<R> held) {
  const Int<R> one(1), most(255);
  switch (op) {
    case StencilOp::keep: return held;
    case StencilOp::zero: return Int<R>(0);
    case StencilOp::replace: return Int<R>(reference);
    case StencilOp::increment: return select(held < most, held + one, held);
    case StencilOp::increment_wrap: return (held + one) & most;
    case StencilOp::decrement: return select(held > Int<R>(0), held - one, held);
    case StencilOp::decrement_wrap: return (held - one) & most;
    case StencilOp::invert: return held ^ most;
  }
  return held;
}

/// Mask of the fragments `alive` that pass the stencil test, whatever the depth test says. The face's op changes the
/// stored value, at `at` (one per lane), of every fragment alive. `passes_depth`: fragments that pass the depth test.
template <class R>
Mask<R> stencil_test(const StencilFace& face, Mask<R> alive, Mask<R> passes_depth, std::uint8_t* at) {
  const Int<R> held = Lanes<R>::load(at), write(face.write_mask), kept(255 & ~face.write_mask);
  const Mask<R> passes = stencil_passes<R>(face, held);
  const auto value = [&](StencilOp op) { return stencil_value<R>(op, face.reference, held); };
  const Int<R> made = select(passes, select(passes_depth, value(face.pass), value(face.depth_fail)), value(face.fail));
  store(alive, (held & kept) | (made & write), at);
  return alive & passes;
}

}  // namespace plumbline::pipeline

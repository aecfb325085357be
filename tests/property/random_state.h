// Random state of a draw's fragments, for random_scene.h.
#pragma once

#include <rapidcheck.h>

#include "scene/scene.h"

namespace plumbline::test {

template <class E>
E any_of(int count) {
  return static_cast<E>(*rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, count)));
}

inline std::uint8_t any_byte() { return any_of<std::uint8_t>(256); }

inline BlendTerm random_blend_term() {
  BlendTerm out;
  out.source = any_of<BlendFactor>(15);
  out.destination = any_of<BlendFactor>(14);  // all but source_alpha_saturate
  out.equation = any_of<BlendEquation>(5);
  return out;
}

/// Small reference values and few masks, so that functions and ops come out differently.
inline StencilFace random_stencil_face() {
  StencilFace out;
  out.func = any_of<CompareFunc>(8);
  out.reference = any_of<std::uint8_t>(4);
  out.mask = *rc::gen::element<std::uint8_t>(0xff, 0xff, 0x01, 0x06);
  out.fail = any_of<StencilOp>(8);
  out.depth_fail = any_of<StencilOp>(8);
  out.pass = any_of<StencilOp>(8);
  out.write_mask = *rc::gen::element<std::uint8_t>(0xff, 0xff, 0x03, 0xf0);
  return out;
}

/// Sets each kind of state in one draw of four; a stencil test, where the frame has stencil values, in one of two.
inline void randomize_state(const FrameFormat& frame, Draw& draw) {
  const auto now_and_then = [] { return any_of<int>(4) == 0; };
  const auto share = [] { return static_cast<float>(any_of<int>(17)) / 16; };
  if (now_and_then()) {
    draw.merge.blend = Blend{random_blend_term(), random_blend_term(), glm::vec4(0)};
    for (int c = 3; c >= 0; --c) draw.merge.blend->color[c] = share();  // backwards: the seeds keep their scenes
  }
  if (now_and_then()) draw.merge.logic_op = any_of<LogicOp>(16);
  if (now_and_then()) {
    const int mask = any_of<int>(16);
    draw.merge.color_mask = glm::bvec4((mask & 1) != 0, (mask & 2) != 0, (mask & 4) != 0, (mask & 8) != 0);
  }
  if (now_and_then()) draw.merge.depth_mask = false;
  if (now_and_then()) draw.scissor = Scissor{any_of<int>(40), any_of<int>(40), any_of<int>(80), any_of<int>(80)};
  if (now_and_then()) draw.depth_range = {share(), share()};
  if (now_and_then()) draw.alpha_test = AlphaTest{any_of<CompareFunc>(8), share()};
  if (now_and_then()) {
    draw.polygon_offset.factor = static_cast<float>(any_of<int>(9) - 4) / 2;
    draw.polygon_offset.units = static_cast<float>(any_of<int>(9) - 4) * 4;
  }
  if (frame.stencil != StencilFormat::none && any_of<int>(2) == 0) {
    draw.stencil = Stencil{random_stencil_face(), random_stencil_face()};
  }
}

}  // namespace plumbline::test

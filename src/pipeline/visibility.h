// Stage 10: the tests between a fragment's colour and its place in the frame (OpenGL 2.1 spec, chapter 4.1).
#pragma once

#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// Alpha test, stencil test, depth test, in this order: whether the fragment is drawn. `nearer`: what the depth test
/// says of it. The stencil value `held` changes where the draw has a stencil test.
bool passes_tests(const Stages& stages, const Draw& draw, bool front, bool nearer, const Shaded& shaded,
                  float color_scale, std::uint8_t* held);

}  // namespace plumbline::pipeline

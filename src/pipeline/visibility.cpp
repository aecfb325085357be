#include "pipeline/visibility.h"

namespace plumbline::pipeline {

bool passes_tests(const Stages& stages, const Draw& draw, bool front, bool nearer, const Shaded& shaded,
                  float color_scale, std::uint8_t* held) {
  bool alive = !shaded.discarded && (nearer || draw.stencil);
  if (draw.alpha_test) alive = alive && stages.alpha_passes(*draw.alpha_test, shaded.color.a, color_scale);
  if (!draw.stencil) return alive;
  const StencilFace& face = front ? draw.stencil->front : draw.stencil->back;
  return stages.stencil_passes(face, alive, nearer, held) && nearer;
}

}  // namespace plumbline::pipeline

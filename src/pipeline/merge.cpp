#include "pipeline/merge.h"

namespace plumbline::pipeline {

void write_fragment(const Stages& stages, const Merge& state, float z, const Color<float>& color, float color_scale,
                    const FramePixel& to) {
  if (state.depth_mask) *to.depth = z;
  const Color<float> made = state.logic_op ? stages.logic(*state.logic_op, color, *to.color, color_scale)
                            : state.blend  ? stages.blend(*state.blend, color, *to.color, color_scale)
                                           : stages.merge(color, color_scale);
  if (state.color_mask.r) to.color->r = made.r;
  if (state.color_mask.g) to.color->g = made.g;
  if (state.color_mask.b) to.color->b = made.b;
  if (state.color_mask.a) to.color->a = made.a;
}

}  // namespace plumbline::pipeline

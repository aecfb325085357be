// Stage 11: a fragment that is drawn, into the frame.
#pragma once

#include "pipeline/frame.h"
#include "pipeline/stages.h"

namespace plumbline::pipeline {

/// Colour by the blend equation, the logic op or as it is, and depth, as far as the masks allow.
void write_fragment(const Stages& stages, const Merge& state, float z, const Color<float>& color, float color_scale,
                    const FramePixel& to);

}  // namespace plumbline::pipeline

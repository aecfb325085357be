// Stage 12: the passes of an antialiased scene (scene/antialias.h) become one frame.
#pragma once

#include <span>

#include "pipeline/frame.h"
#include "scene/antialias.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Function that resolves one channel of a pixel. `values`: one per sample. Values and result are in the frame's
/// format: codes up to `scale`; scale 0: floats.
using Resolve = float (*)(std::span<const float> values, std::span<const PixelSample> samples, float scale);

/// Mean of four samples of equal weight, in float: (((a + b) + c) + d) * 0.25, where a code enters as code * (1/scale);
/// rounded to the nearest code, half to even. OpenGL 4.5, section 18.3.1, leaves the arithmetic open; this order is
/// llvmpipe's, and decides where the mean lies half way between two codes.
float mean_of_four(std::span<const float> values, std::span<const PixelSample> samples, float scale);
/// Weighted mean, in double, rounded once; of codes to the nearest code, half up.
float weighted_mean(std::span<const float> values, std::span<const PixelSample> samples, float scale);

/// Functions that resolve each kind of antialiasing. Tests and faults may replace them.
struct ResolveStage {
  Resolve multisample = mean_of_four;
  Resolve weighted = weighted_mean;  ///< supersample and taps
  bool operator==(const ResolveStage&) const = default;
};

/// Resolves an antialiased frame. `passes`: the frames of passes_of(scene), in order; `to`: a Frame(format). Depth is
/// that of a pixel's first sample; stencil values are 0.
void resolve(const ResolveStage& stage, const FrameFormat& format, std::span<const Frame> passes, Frame& to);
Frame resolve(const ResolveStage& stage, const FrameFormat& format, std::span<const Frame> passes);

}  // namespace plumbline::pipeline

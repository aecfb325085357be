// Merge states and frames of tests of blending.
#pragma once

#include "scene/scene.h"

namespace plumbline {

/// Blending of rgb and of alpha alike, with a constant colour of four unlike channels.
inline Merge blending(BlendFactor source, BlendFactor destination, BlendEquation equation = BlendEquation::add) {
  Merge out;
  out.blend = Blend{{source, destination, equation}, {source, destination, equation}, {0.5f, 0.25f, 0.75f, 0.125f}};
  return out;
}
/// A frame of the clear colour.
inline FrameFormat frame_of(ColorFormat color, glm::vec4 clear) {
  FrameFormat frame;
  frame.color = color;
  frame.clear_color = clear;
  return frame;
}

}  // namespace plumbline

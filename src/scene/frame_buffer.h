// The frame buffer in numbers (note 004, class 1): resolution, pixel depth, buffer size.
#pragma once

#include <cstddef>

#include "scene/scene.h"

namespace plumbline {

/// Memory of a buffer of width x height pixels [bytes]: the notes' exam question.
constexpr std::size_t buffer_bytes(int width, int height, std::size_t pixel_bytes) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * pixel_bytes;
}

/// Pixel depth: bytes of one pixel's colour and depth, as pipeline/frame.h keeps them (four channels, 12 bits in 2
/// bytes each; depth in 4 bytes whatever its format). Stencil values are not counted.
constexpr std::size_t pixel_bytes(const FrameFormat& frame) {
  constexpr std::size_t kDepth = 4;
  switch (frame.color) {
    case ColorFormat::rgba8: return 4 + kDepth;
    case ColorFormat::rgba12:
    case ColorFormat::rgba16: return 8 + kDepth;
    case ColorFormat::rgba32f: return 16 + kDepth;
  }
  return 0;
}

constexpr std::size_t buffer_bytes(const FrameFormat& frame) {
  return buffer_bytes(frame.width, frame.height, pixel_bytes(frame));
}

}  // namespace plumbline

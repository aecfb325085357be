// The frame: FrameBuffer, in floats, while it is drawn; Frame, in its own formats, when it is finished.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "capture/plane.h"
#include "kernels/attributes.h"
#include "scene/scene.h"

namespace plumbline::pipeline {

/// Finished frame. Row 0 is the bottom row, in dialect gzrender the top row (scene.h, rows_from_top). Of the colour
/// planes, and of the depth planes, only the one of the frame's format is filled.
struct Frame {
  explicit Frame(const FrameFormat& format);  ///< all values 0, whatever the clear values
  /// Whether the planes have been moved away.
  bool empty() const { return depth_code.empty() && depth_z32f.empty(); }

  Plane<glm::u8vec4> color_rgba8;
  Plane<glm::u16vec4> color_rgba16;  ///< rgba12, too: 0 to 4095
  Plane<glm::vec4> color_rgba32f;
  Plane<std::uint32_t> depth_code;  ///< z8, z16, z24
  Plane<float> depth_z32f;
  Plane<std::uint8_t> stencil;  ///< empty where the format has none
};

/// Number formats of a frame.
struct Formats {
  double depth_scale;    ///< largest depth code; 0: float
  float color_scale;     ///< largest colour code; 0: float
  glm::ivec2 sample{0};  ///< offset from a pixel's centre to the pass' sample [1/256 pixel] (scene/antialias.h)
};
Formats formats_of(const FrameFormat& frame);

/// Values of a cleared pixel, in the frame's formats, as floats.
struct ClearPixel {
  float depth;
  Color<float> color;
};
ClearPixel clear_pixel(const FrameFormat& frame);

/// Addresses of one pixel's values in a FrameBuffer.
struct FramePixel {
  float* depth;           ///< code, or window z
  glm::vec4* color;       ///< codes, or floats
  std::uint8_t* stencil;  ///< null where the format has none
};

/// The frame while it is drawn: codes as floats, which hold them exactly.
struct FrameBuffer {
  explicit FrameBuffer(const FrameFormat& format);  ///< cleared
  FramePixel at(glm::ivec2 pixel);                  ///< `pixel` is in the frame

  Plane<float> depth;
  Plane<glm::vec4> color;
  Plane<std::uint8_t> stencil;  ///< empty where the format has none
};
/// The buffer's values, converted to the frame's formats.
Frame finished(const FrameFormat& format, const FrameBuffer& buffer);

}  // namespace plumbline::pipeline
